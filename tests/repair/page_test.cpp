// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/vectors.h"
#include "pipeline/load.h"
#include "support/base64_values.h"
#include "support/program.h"

// What the page of a repair says of the model before and after, and what --debris holds: compared with what the files say, which are
// read here, and with areas and lengths that are known.

namespace geomend {
namespace {

using nlohmann::json;
using test::read_file;
using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

json page_of(const std::string& path) {
    const std::string page = read_file(path), head = "<script type=\"application/json\" id=\"report\">";
    const std::size_t first = page.find(head);
    if (first == std::string::npos) return {};
    const json data = json::parse(page.substr(first + head.size(), page.find("</script>", first) - first - head.size()), nullptr, false);
    return data["files"][0];
}

template <class Value>
std::vector<Value> values(const json& part, const char* key) {
    return test::base64_values<Value>(part.value(key, std::string()));
}

std::string change_of(const json& part) { return part.value("change", "none"); }

std::vector<Vec3> points_of(const json& scene, const json& part) {
    const auto xyz = values<float>(part, "points");
    std::vector<Vec3> points;
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
        Vec3 p{};
        for (std::size_t k = 0; k < 3; ++k) p[k] = scene["origin"][k].get<double>() + double(xyz[i + k]);
        points.push_back(p);
    }
    return points;
}

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * length(cross(minus(b, a), minus(c, a))); }

/// Of the surfaces in a scene, or of those of a name.
double area_of(const json& scene, const std::string& change, const std::string& name = {}) {
    double sum = 0;
    for (const json& part : scene["parts"]) {
        if (change_of(part) != change || (!name.empty() && part["name"] != name)) continue;
        const auto points = points_of(scene, part);
        const auto t = values<std::uint32_t>(part, "triangles");
        for (std::size_t i = 0; i + 2 < t.size(); i += 3) sum += area(points[t[i]], points[t[i + 1]], points[t[i + 2]]);
    }
    return sum;
}

double length_of_lines(const json& scene, const std::string& change) {
    double sum = 0;
    for (const json& part : scene["parts"]) {
        if (change_of(part) != change || !part.contains("lines")) continue;
        const auto points = points_of(scene, part);
        const auto n = values<std::uint32_t>(part, "lines");
        std::size_t at = 0;
        for (const std::size_t count : part["lengths"].get<std::vector<std::size_t>>()) {
            for (std::size_t i = 1; i < count; ++i) sum += length(minus(points[n[at + i]], points[n[at + i - 1]]));
            at += count;
        }
    }
    return sum;
}

double area_of_file(const std::string& path) {
    const auto dataset = load(path, {});
    if (!dataset) return -1;
    double sum = 0;
    for (const Object& object : dataset->objects) {
        const auto* surface = std::get_if<Surface>(&object);
        for (std::size_t p = 0; surface != nullptr && p < surface->polygons.size(); ++p) {
            const auto t = surface->polygons[p];
            sum += area(surface->points[t[0]], surface->points[t[1]], surface->points[t[2]]);
        }
    }
    return sum;
}

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string tsurf(const std::string& name, const std::vector<Vec3>& points, const std::vector<std::array<std::size_t, 3>>& triangles) {
    std::string text = "GOCAD TSurf 1\nHEADER {\nname: " + name + "\n}\nTFACE\n";
    for (std::size_t i = 0; i < points.size(); ++i)
        text +=
            "VRTX " + std::to_string(i + 1) + ' ' + number(points[i][0]) + ' ' + number(points[i][1]) + ' ' + number(points[i][2]) + '\n';
    for (const auto& [a, b, c] : triangles)
        text += "TRGL " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
    return text + "END\n";
}

const std::vector<std::array<std::size_t, 3>> halves = {{0, 1, 2}, {0, 2, 3}};

/// Six squares of a cube of 10, each moved outwards by `apart`.
std::string cube_of_squares(double apart) {
    std::string text;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const bool high : {false, true}) {
            std::vector<Vec3> square;
            for (const auto& [u, v] : {std::pair{0, 0}, {10, 0}, {10, 10}, {0, 10}}) {
                Vec3 p{};
                p[axis] = high ? 10 + apart : -apart;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                square.push_back(p);
            }
            text += tsurf("side_" + std::to_string(2 * axis + (high ? 1 : 0)), square, halves);
        }
    }
    return text;
}

/// A sheet of 4 x 4 squares from `west` on; the points of its border at x = 4 are moved by up to `by`.
std::string sheet(const std::string& name, double west, double by) {
    std::vector<Vec3> points;
    std::vector<std::array<std::size_t, 3>> triangles;
    for (std::size_t j = 0; j < 5; ++j) {
        for (std::size_t i = 0; i < 5; ++i) {
            Vec3 p{west + double(i), double(j), 0.3 * double(i * j % 3)};
            if (p[0] == 4) p = {4 + by * std::cos(double(j)), double(j) + by * std::sin(3.0 * double(j)), by * double(j) / 7};
            points.push_back(p);
        }
    }
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
            triangles.push_back({5 * j + i, 5 * j + i + 1, 5 * j + i + 6});
            triangles.push_back({5 * j + i, 5 * j + i + 6, 5 * j + i + 5});
        }
    }
    return tsurf(name, points, triangles);
}

/// Per surface of a file its points.
std::map<std::string, std::vector<Vec3>> points_by_surface(const std::string& path) {
    std::map<std::string, std::vector<Vec3>> all;
    const auto dataset = load(path, {});
    for (const Object& object : dataset->objects) {
        if (const auto* surface = std::get_if<Surface>(&object)) all[surface->info.name] = surface->points;
    }
    return all;
}

double nearest(const std::vector<Vec3>& points, const Vec3& p) {
    double best = INFINITY;
    for (const Vec3& q : points) best = std::min(best, length(minus(p, q)));
    return best;
}

TEST(RepairPage, EachPointSaysHowFarItMovedInItsSurface) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", sheet("left", 0, 0) + sheet("right", 4, 0.004));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "weld", "--tolerance", "0.01",
                                  "--keep-invalid", "--report", folder / "page.html"});
    ASSERT_TRUE(std::filesystem::exists(folder / "out.ts")) << run.out << run.err;
    const auto before = points_by_surface(folder / "in.ts"), after = points_by_surface(folder / "out.ts");
    // Points stand 1 apart, and moved by less than a hundredth: the nearest one is the same point.
    double largest = 0, sum = 0;
    std::size_t moved = 0, vertices = 0;
    for (const auto& [name, points] : before) {
        for (const Vec3& p : points) {
            const double by = nearest(after.at(name), p);
            ++vertices;
            moved += by > 0 ? 1 : 0;
            largest = std::max(largest, by);
            sum += by;
        }
    }
    ASSERT_GE(moved, 4u);
    const json page = page_of(folder / "page.html");
    EXPECT_EQ(page["changes"]["vertices"], vertices);
    EXPECT_EQ(page["changes"]["moved"], moved);
    EXPECT_NEAR(page["changes"]["largest"].get<double>(), largest, 1e-12);
    EXPECT_NEAR(page["changes"]["mean"].get<double>(), sum / double(moved), 1e-12);
    std::size_t told = 0;
    for (const json& part : page["scene"]["parts"]) {
        if (part["kind"] != "surface") continue;
        const auto by = values<float>(part, "moved");
        const auto points = points_of(page["scene"], part);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double expected = nearest(before.at(part["name"]), points[i]), said = by.empty() ? 0 : double(by[i]);
            EXPECT_NEAR(said, expected, 2e-6) << part["name"] << ' ' << i;  // positions are in single precision
            told += said > 0 ? 1 : 0;
        }
    }
    EXPECT_EQ(told, moved);
    for (const json& step : page["steps"]) EXPECT_NEAR(step["max_displacement"].get<double>(), largest, 1e-12);
}

TEST(RepairPage, StripsAreAddedPartsAndTheirLinesAreCuts) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    const auto run =
        run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--max-gap", "0.4", "--report", folder / "page.html"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    const json page = page_of(folder / "page.html"), &before = page["changes"]["before"], &after = page["scene"];
    EXPECT_NEAR(area_of(before, "none"), 600, 1e-3);
    EXPECT_NEAR(area_of(after, "none"), 600, 1e-3) << "what was read is there";
    EXPECT_NEAR(area_of(after, "added"), 6 * 10.4 * 10.4 - 600, 1e-3);
    EXPECT_NEAR(length_of_lines(after, "cut"), 12 * 10.4, 1e-3);
    EXPECT_EQ(length_of_lines(after, "joined"), 0);
    EXPECT_EQ(page["changes"]["moved"], 0);
    EXPECT_EQ(before["origin"], after["origin"]) << "one camera serves both";
    ASSERT_EQ(run_geomend({"validate", folder / "in.ts", "--report", folder / "v.json"}).status, 0);
    const json counts = json::parse(read_file(folder / "v.json"))["files"][0]["counts"];
    EXPECT_EQ(page["changes"]["errors_before"], counts["error"]);
    EXPECT_EQ(page["changes"]["warnings_before"], counts["warning"]);
    EXPECT_FALSE(page.contains("removed")) << "what was cut from strips was never read";
}

TEST(RepairPage, BordersThatBecameOneAreJoinedAndNotCut) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", sheet("left", 0, 0) + sheet("right", 4, 0.004));
    run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "weld", "--tolerance", "0.01", "--keep-invalid",
                 "--report", folder / "page.html"});
    const json page = page_of(folder / "page.html");
    EXPECT_EQ(page["changes"]["joined_edges"], 4);
    EXPECT_EQ(page["changes"]["cut_edges"], 0);
    EXPECT_GE(length_of_lines(page["scene"], "joined"), 4 - 1e-6);
}

TEST(RepairPage, WhatWasLeftOutIsDrawnBeforeAndWrittenAsDebrisWithTheReason) {
    const TemporaryFolder folder;
    const std::vector<Vec3> corners = {{-1, -1, 4}, {11, -1, 4}, {11, 11, 6}, {-1, 11, 6}};
    write_file(folder / "in.ts", cube_of_squares(0) + tsurf("sheet", corners, halves));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--report", folder / "page.html", "--report",
                                  folder / "report.json", "--debris", folder / "debris"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    const double slope = std::hypot(12.0, 2.0) / 12, outside = (144 - 100) * slope;
    const json page = page_of(folder / "page.html");
    EXPECT_NEAR(area_of(page["changes"]["before"], "removed", "sheet"), outside, 1e-3);
    EXPECT_NEAR(area_of(page["changes"]["before"], "removed"), outside, 1e-3) << "and nothing else";
    EXPECT_NEAR(length_of_lines(page["scene"], "cut"), 4 * 10 + 2 * 10 * (slope - 1), 1e-3);
    const json removed = json::parse(read_file(folder / "report.json"))["files"][0]["removed"];
    double in_ts = 0, in_vtp = 0;
    std::size_t files = 0;
    for (const json& piece : removed) {
        EXPECT_EQ(piece["surface"], "sheet");
        EXPECT_EQ(piece["step"], "tails");
        EXPECT_EQ(piece["kind"], "outside");
        EXPECT_NE(piece["why"].get<std::string>().find("boundary"), std::string::npos);
        for (const auto& file : piece["debris"].get<std::vector<std::string>>()) {
            ++files;
            EXPECT_NE(file.find("-outside-sheet."), std::string::npos) << file;
            EXPECT_NE(read_file(file).find("sticks out of the closed outer boundary (tails)"), std::string::npos) << file;
            (file.ends_with(".ts") ? in_ts : in_vtp) += area_of_file(file);
            EXPECT_EQ(run_geomend({"info", file}).status, 0) << file;
        }
    }
    EXPECT_EQ(files, 2 * removed.size());
    EXPECT_NEAR(in_ts, outside, 1e-7);
    EXPECT_NEAR(in_vtp, outside, 1e-7);
}

TEST(RepairPage, DebrisAloneNeedsNoPage) {
    const TemporaryFolder folder;
    const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    write_file(folder / "in.ts", tsurf("s", points, {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {0, 2, 3}}));
    const auto run =
        run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "clean", "--keep-invalid", "--debris", folder / "d"});
    std::size_t flat = 0, twice = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "d")) {
        flat += entry.path().filename().string().find("-no-area-s.") != std::string::npos ? 1 : 0;
        twice += entry.path().filename().string().find("-double-s.") != std::string::npos ? 1 : 0;
    }
    EXPECT_EQ(flat, 2u) << run.out << run.err;
    EXPECT_EQ(twice, 2u);
}

TEST(RepairPage, AHorizonThatWasMovedSaysByHowMuchInTheUnitOfTheModel) {
    const TemporaryFolder folder;
    write_file(folder / "r.toml", "[[edit]]\naction = \"move\"\nsurface = \"H2\"\nby = [0, 0, -20]\n");
    const auto run = run_geomend({"repair", std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml", "--recipe", folder / "r.toml",
                                  "-o", folder / "out.ml", "--report", folder / "page.html"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    const json page = page_of(folder / "page.html");
    EXPECT_EQ(page["changes"]["unit"], "m");
    EXPECT_NEAR(page["changes"]["largest"].get<double>(), 20, 1e-9);
    EXPECT_NEAR(page["changes"]["mean"].get<double>(), 20, 1e-9);
    std::size_t whole = 0;
    for (const json& part : page["scene"]["parts"]) {
        const auto by = values<float>(part, "moved");
        if (part["kind"] == "surface" && part["role"] != "horizon") {
            EXPECT_TRUE(by.empty()) << part["name"];
        }
        whole += static_cast<std::size_t>(std::ranges::count(by, 20.0f));
        for (const float d : by) EXPECT_LE(d, 20.5f);  // where it was lengthened, from where it ended
    }
    EXPECT_GT(whole, 20u);
}

TEST(RepairPage, WhatAnEditBringsInIsAddedAndItsFileIsFoundBesideTheRecipe) {
    const TemporaryFolder folder;
    for (const char* sub : {"recipes", "again"}) std::filesystem::create_directory(folder / sub);
    write_file(folder / "recipes/sheet.ts", tsurf("sheet", {{-1, -1, 4}, {11, -1, 4}, {11, 11, 6}, {-1, 11, 6}}, halves));
    write_file(folder / "recipes/r.toml", "[[edit]]\naction = \"add\"\nfile = \"sheet.ts\"\n");
    write_file(folder / "in.ts", cube_of_squares(0));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--recipe", folder / "recipes/r.toml",
                                  "--write-recipe", folder / "again/r.toml", "--report", folder / "page.html"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    const json page = page_of(folder / "page.html");
    EXPECT_NEAR(area_of(page["scene"], "added"), 100 * std::hypot(12.0, 2.0) / 12, 1e-3);
    EXPECT_NEAR(area_of(page["scene"], "none"), 600, 1e-3);
    EXPECT_FALSE(page.contains("removed")) << "what sticks out was never in the model";
    const auto again = run_geomend({"repair", folder / "in.ts", "-o", folder / "again.ml", "--recipe", folder / "again/r.toml"});
    EXPECT_EQ(again.status, 0) << again.out << again.err << read_file(folder / "again/r.toml");
    EXPECT_EQ(read_file(folder / "again.ml"), read_file(folder / "out.ml"));
}

TEST(RepairPage, ABoxThatWasAddedIsAddedWhole) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", tsurf("sheet", {{-1, -1, 4}, {11, -1, 4}, {11, 11, 6}, {-1, 11, 6}}, halves));
    const auto run =
        run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--box", "0,10,0,10,0,10", "--report", folder / "page.html"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    const json page = page_of(folder / "page.html");
    EXPECT_NEAR(area_of(page["scene"], "added"), 600, 1e-3);
    EXPECT_NEAR(area_of(page["scene"], "none"), 100 * std::hypot(12.0, 2.0) / 12, 1e-3);
}

}  // namespace
}  // namespace geomend
