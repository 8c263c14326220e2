// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include "support/program.h"
#include "support/real_data.h"

// Repair of models of surfaces from the command line, as a user runs it.

namespace geomend {
namespace {

using test::info;
using test::read_file;
using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

using Point = std::array<double, 3>;
using Triangles = std::vector<std::array<int, 3>>;

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string tsurf(const std::string& name, const std::vector<Point>& points, const Triangles& triangles, const std::string& property = {},
                  const std::vector<double>& values = {}) {
    std::string text = "GOCAD TSurf 1\nHEADER {\nname: " + name + "\n}\n";
    if (!property.empty()) text += "PROPERTIES " + property + "\n";
    text += "TFACE\n";
    for (std::size_t i = 0; i < points.size(); ++i) {
        text += std::string(property.empty() ? "VRTX " : "PVRTX ") + std::to_string(i + 1);
        for (const double x : points[i]) text += ' ' + number(x);
        if (!property.empty()) text += ' ' + number(values[i]);
        text += '\n';
    }
    for (const auto& t : triangles) {
        text += "TRGL " + std::to_string(t[0] + 1) + ' ' + std::to_string(t[1] + 1) + ' ' + std::to_string(t[2] + 1) + '\n';
    }
    return text + "END\n";
}

const Triangles halves = {{0, 1, 2}, {0, 2, 3}};

/// Six squares of a cube of 10, each moved outwards by `apart`, so that they do not meet.
std::string cube_of_squares(double apart) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
        for (int high = 0; high < 2; ++high) {
            const double at = high != 0 ? 10 + apart : -apart;
            std::vector<Point> square;
            for (const auto& [u, v] : {std::pair{0, 0}, {10, 0}, {10, 10}, {0, 10}}) {
                Point p{};
                p[static_cast<std::size_t>(axis)] = at;
                p[static_cast<std::size_t>((axis + 1) % 3)] = u;
                p[static_cast<std::size_t>((axis + 2) % 3)] = v;
                square.push_back(p);
            }
            text += tsurf("side_" + std::to_string(2 * axis + high), square, halves);
        }
    }
    return text;
}

nlohmann::json brep_of(const std::string& file) { return info(file)["brep"]; }

std::vector<int> counts(const nlohmann::json& brep) {
    std::vector<int> all;
    for (const char* key : {"corners", "lines", "surfaces", "regions"}) all.push_back(brep[key].get<int>());
    return all;
}

double total_volume(const nlohmann::json& brep) {
    double sum = 0;
    for (const auto& region : brep["region_volumes"]) sum += region["volume"].get<double>();
    return sum;
}

TEST(SurfaceRepair, SquaresThatStopShortOfEachOtherBecomeASealedBox) {
    const TemporaryFolder folder;
    for (const double apart : {0.01, 0.2, 0.3}) {
        write_file(folder / "in.ts", cube_of_squares(apart));
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--max-gap", "0.4"});
        EXPECT_EQ(run.status, 0) << run.out << run.err;
        const auto brep = brep_of(folder / "out.ml");
        EXPECT_EQ(counts(brep), (std::vector<int>{8, 12, 6, 1})) << apart;
        EXPECT_NEAR(total_volume(brep), std::pow(10 + 2 * apart, 3), 1e-5) << "each square is extended in its own plane";
    }
}

// A second part of the same surface begins along a border of the first one, bends over it and ends in its middle: joined at both ends they
// would be one surface that goes through a line three times.
TEST(SurfaceRepair, PartsOfOneSurfaceThatEndOnEachOtherStayPartsWhereTheyAreJoinedElsewhere) {
    const TemporaryFolder folder;
    const std::vector<Point> points = {{0, 0, 0},     {200, 0, 0},   {200, 100, 0}, {0, 100, 0},   {200, 25, 0}, {200, 75, 0},
                                       {200, 75, 80}, {200, 25, 80}, {100, 75, 80}, {100, 25, 80}, {100, 75, 0}, {100, 25, 0}};
    const Triangles triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {7, 6, 8}, {7, 8, 9}, {9, 8, 10}, {9, 10, 11}};
    write_file(folder / "in.ts", tsurf("bent", points, triangles));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--steps", "cut,rebuild"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(brep_of(folder / "out.ml")["surfaces"], 2);
    EXPECT_EQ(run_geomend({"validate", folder / "out.ml"}).status, 0);
}

// The same with one set of points, so that it is read as one part.
TEST(SurfaceRepair, ASurfaceThatIsNotManifoldIsPartedAtItsSharpestBends) {
    const TemporaryFolder folder;
    const std::vector<Point> points = {{0, 0, 0},    {200, 0, 0},  {200, 100, 0}, {0, 100, 0},   {200, 25, 0},  {200, 75, 0},
                                       {100, 25, 0}, {100, 75, 0}, {200, 75, 80}, {200, 25, 80}, {100, 75, 80}, {100, 25, 80}};
    const Triangles triangles = {{0, 1, 6}, {1, 4, 6}, {4, 5, 7}, {4, 7, 6},  {5, 2, 7},   {2, 3, 7},   {0, 6, 7},
                                 {0, 7, 3}, {5, 4, 9}, {5, 9, 8}, {8, 9, 11}, {8, 11, 10}, {10, 11, 6}, {10, 6, 7}};
    write_file(folder / "in.ts", tsurf("bent", points, triangles));
    EXPECT_NE(run_geomend({"validate", folder / "in.ts"}).out.find("B03"), std::string::npos);
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(brep_of(folder / "out.ml")["surfaces"], 2);
    const auto after = run_geomend({"validate", folder / "out.ml"});
    EXPECT_EQ(after.status, 0) << after.out;
    EXPECT_EQ(after.out.find("B03"), std::string::npos) << after.out;
}

TEST(SurfaceRepair, GapsBeyondTheLimitAreLeftAndNothingIsWritten) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.6));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--max-gap", "0.4", "--json"});
    const auto j = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_TRUE(j.contains("contacts")) << run.out << run.err;
    EXPECT_FALSE(j["contacts"].empty());
    for (const auto& contact : j["contacts"]) EXPECT_EQ(contact["decision"], "left");
}

TEST(SurfaceRepair, ACubeWithAnUncutSheetBecomesTwoRegions) {
    const TemporaryFolder folder;
    const std::string sheet = tsurf("sheet", {{-1, -1, 4}, {11, -1, 4}, {11, 11, 6}, {-1, 11, 6}}, halves);
    write_file(folder / "in.ts", cube_of_squares(0) + sheet);
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const auto brep = brep_of(folder / "out.ml");
    EXPECT_EQ(brep["regions"], 2);
    EXPECT_NEAR(total_volume(brep), 1000, 1e-6);
    for (const auto& region : brep["region_volumes"]) EXPECT_NEAR(region["volume"].get<double>(), 500, 1e-6);
    EXPECT_EQ(run_geomend({"validate", folder / "out.ml", "--fail-on", "warning"}).status, 0);
}

TEST(SurfaceRepair, PropertiesAreThoseOfThePlaceWhereATriangleLay) {
    const TemporaryFolder folder;
    const std::vector<Point> corners = {{-1, -1, 4}, {11, -1, 4}, {11, 11, 6}, {-1, 11, 6}};
    std::vector<double> values;
    for (const Point& p : corners) values.push_back(3 * p[0] - 2 * p[1] + 7);
    write_file(folder / "in.ts", cube_of_squares(0) + tsurf("sheet", corners, halves, "linear", values));
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts"}).status, 0);
    const std::string text = read_file(folder / "out.ts");
    std::istringstream lines(text);
    std::size_t seen = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key;
        double id = 0, x = 0, y = 0, z = 0, value = 0;
        if (!(words >> key >> id >> x >> y >> z >> value) || key != "PVRTX") continue;
        EXPECT_NEAR(value, 3 * x - 2 * y + 7, 1e-9) << line;
        ++seen;
    }
    EXPECT_GT(seen, 4u) << text;
}

TEST(SurfaceRepair, LooseSurfacesInAndOutNeedNoAcceptedLoss) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    EXPECT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--max-gap", "0.4"}).status, 0);
    EXPECT_EQ(run_geomend({"validate", folder / "out.ts"}).status, 0);
}

TEST(SurfaceRepair, ASealedModelKeepsItsNamesAndCounts) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";
    const auto run = run_geomend({"repair", sample, "-o", folder / "out.ml", "--steps", "clean,weld,cut,tails,rebuild"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const auto before = brep_of(sample), after = brep_of(folder / "out.ml");
    EXPECT_EQ(counts(after), counts(before));
    const auto by_name = [](const nlohmann::json& brep) {
        std::map<std::string, double> volumes;
        for (const auto& region : brep["region_volumes"]) volumes[region["name"]] = region["volume"];
        return volumes;
    };
    const auto had = by_name(before), has = by_name(after);
    ASSERT_EQ(had.size(), has.size());
    for (const auto& [name, volume] : had) {
        ASSERT_TRUE(has.contains(name)) << name;
        EXPECT_NEAR(has.at(name), volume, 1e-6 * volume) << name;
    }
    EXPECT_EQ(after["layers"], before["layers"]);
    EXPECT_EQ(after["features"], before["features"]);
}

TEST(SurfaceRepair, PointsMovedWithinTheToleranceAreWeldedToTheSameModel) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";
    ASSERT_EQ(run_geomend({"convert", sample, "-o", folder / "loose.ts", "--lossy"}).status, 0);
    constexpr double tolerance = 0.01;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        std::mt19937 engine(seed);
        std::istringstream lines(read_file(folder / "loose.ts"));
        std::string moved;
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string key, id, rest;
            Point p{};
            if ((words >> key) && (key == "VRTX" || key == "PVRTX") && (words >> id >> p[0] >> p[1] >> p[2])) {
                std::getline(words, rest);
                moved += key + ' ' + id;
                for (const double x : p) moved += ' ' + number(x + tolerance / 4 * (static_cast<double>(engine()) / 2147483648.0 - 1));
                moved += rest + '\n';
            } else {
                moved += line + '\n';
            }
        }
        write_file(folder / "moved.ts", moved);
        const auto run = run_geomend({"repair", folder / "moved.ts", "-o", folder / "out.ml", "--tolerance", "0.01"});
        EXPECT_EQ(run.status, 0) << run.out << run.err;
        const auto before = brep_of(sample), after = brep_of(folder / "out.ml");
        EXPECT_EQ(counts(after), counts(before)) << "seed " << seed;
        EXPECT_NEAR(total_volume(after), total_volume(before), 1e-5 * total_volume(before));
    }
}

// RINGMesh's repair of the same file: horizons that touch themselves at points with doubled nodes have all of their nodes joined, also
// along faults that end in them, and each node of such a line is a corner of the horizon.
TEST(SurfaceRepair, SurfacesThatDoubleNodesWhereNothingCutsThemHaveTheCountsOfTheirPublishedRepair) {
    const auto broken = test::real_data("gocad/CloudSpin.ml"), published = test::real_data("gocad/CloudSpin_fixed.ml");
    if (!broken || !published) GTEST_SKIP() << "no real data";
    const std::string in = broken->string(), fixed = published->string();
    const TemporaryFolder folder;
    const auto volumes = [](const nlohmann::json& brep) {
        std::map<std::string, double> all;
        for (const auto& region : brep["region_volumes"]) all[region["name"]] = region["volume"];
        return all;
    };
    const auto known = volumes(brep_of(fixed));
    for (const auto& file : {in, fixed}) {
        for (const std::vector<std::string>& options : {std::vector<std::string>{}, {"--steps", "clean,weld,cut,tails,rebuild"}}) {
            std::vector<std::string> words{"repair", file, "-o", folder / "out.ml"};
            words.insert(words.end(), options.begin(), options.end());
            const auto run = run_geomend(words);
            EXPECT_EQ(run.status, 0) << run.out << run.err;
            EXPECT_EQ(run.out.find("20 doubled points were joined") != std::string::npos, file == in) << run.out.substr(0, 2000);
            const auto brep = brep_of(folder / "out.ml");
            EXPECT_EQ(counts(brep), (std::vector<int>{148, 249, 115, 7})) << file;
            const auto now = volumes(brep);
            ASSERT_EQ(now.size(), known.size());
            for (const auto& [name, volume] : known) EXPECT_NEAR(now.at(name), volume, 1e-6 * volume) << name;
        }
    }
}

/// A box with a sheet in its middle and a fault that stands on its floor, goes through the sheet and dies out inside.
std::string box_with_dying_fault() {
    return cube_of_squares(0) + tsurf("sheet", {{0, 0, 5}, {10, 0, 5}, {10, 10, 5}, {0, 10, 5}}, halves) +
           tsurf("fault", {{5, 0, 0}, {5, 4, 0}, {5, 4, 8}, {5, 0, 8}}, halves);
}

/// The text of a model in which all nodes of a part of a surface that are at one place are one.
std::string with_joined_nodes(const std::string& text) {
    std::istringstream lines(text);
    std::map<std::string, std::string> first, now;  // node by place in this part; what a node has become
    std::string joined;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key, id, x, y, z;
        words >> key;
        if (key == "TFACE" || key == "GOCAD") first.clear();
        if (key == "GOCAD") now.clear();
        if (key == "VRTX" || key == "PVRTX") {
            words >> id >> x >> y >> z;
            now[id] = first.emplace(x + ' ' + y + ' ' + z, id).first->second;
        }
        if (key == "ATOM") {
            words >> id >> x;
            now[id] = first.emplace("of " + now[x], now[x]).first->second;
        }
        if (key == "TRGL") {
            words >> x >> y >> z;
            line = "TRGL " + now[x] + ' ' + now[y] + ' ' + now[z];
        }
        joined += line + '\n';
    }
    return joined;
}

TEST(SurfaceRepair, ALineThatDoesNotCutASurfaceByItsNodesStillDoesNot) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", box_with_dying_fault());
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "cut.ml"}).status, 0);
    write_file(folder / "joined.ml", with_joined_nodes(read_file(folder / "cut.ml")));
    const auto cut = brep_of(folder / "cut.ml"), joined = brep_of(folder / "joined.ml");
    ASSERT_GE(counts(joined)[0], counts(cut)[0]);
    for (const char* name : {"cut.ml", "joined.ml"}) {
        ASSERT_EQ(run_geomend({"repair", folder / name, "-o", folder / "out.ml", "--steps", "weld,cut,rebuild"}).status, 0);
        EXPECT_EQ(brep_of(folder / "out.ml")["internal_lines"], brep_of(folder / name)["internal_lines"]) << name;
        EXPECT_EQ(counts(brep_of(folder / "out.ml")), counts(brep_of(folder / name))) << name;
    }
}

TEST(SurfaceRepair, SeveralInputsAreOneModel) {
    const TemporaryFolder folder;
    write_file(folder / "box.ts", cube_of_squares(0));
    write_file(folder / "sheet.ts", tsurf("sheet", {{-1, -1, 5}, {11, -1, 5}, {11, 11, 5}, {-1, 11, 5}}, halves));
    const auto run = run_geomend({"repair", folder / "box.ts", folder / "sheet.ts", "-o", folder / "out.ml"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(brep_of(folder / "out.ml")["regions"], 2);
}

TEST(SurfaceRepair, AModelAndASurfaceThatLiesOnOneOfItsOwnBecomeOneModel) {
    const TemporaryFolder folder;
    write_file(folder / "box.ts", cube_of_squares(0));
    ASSERT_EQ(run_geomend({"repair", folder / "box.ts", "-o", folder / "box.ml"}).status, 0);
    const Triangles other_halves = {{0, 1, 3}, {1, 2, 3}};
    const std::vector<std::pair<std::vector<Point>, Triangles>> copies = {
        {{{0, 0, 10}, {10, 0, 10}, {10, 10, 10}, {0, 10, 10}}, halves},
        {{{0, 0, 10}, {10, 0, 10}, {10, 10, 10}, {0, 10, 10}}, other_halves},
        {{{2, 3, 10}, {7, 3, 10}, {7, 8, 10}, {2, 8, 10}}, halves},
        {{{10, 2, 3}, {10, 7, 3}, {10, 7, 12}, {10, 2, 12}}, halves}};
    for (const auto& [points, triangles] : copies) {
        write_file(folder / "copy.ts", tsurf("copy", points, triangles));
        const std::string both = read_file(folder / "box.ml") + read_file(folder / "copy.ts");
        write_file(folder / "both.ml", both);
        EXPECT_NE(run_geomend({"validate", folder / "both.ml"}).out.find("B33"), std::string::npos);
        for (const auto& inputs : {std::vector<std::string>{"box.ml", "copy.ts"}, {"both.ml"}}) {
            std::vector<std::string> words{"repair", "-o", folder / "out.ml"};
            for (const std::string& input : inputs) words.push_back(folder / input);
            const auto run = run_geomend(words);
            EXPECT_EQ(run.status, 0) << run.out << run.err;
            EXPECT_EQ(brep_of(folder / "out.ml")["regions"], 1);
            EXPECT_NEAR(total_volume(brep_of(folder / "out.ml")), 1000, 1e-6);
            std::filesystem::remove(folder / "out.ml");
        }
    }
}

TEST(SurfaceRepair, ABoxMakesAVolumeOfAnOpenSetOfSurfaces) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", tsurf("H1", {{0, 0, 5}, {10, 0, 5}, {10, 10, 5}, {0, 10, 5}}, halves));
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--box", "1,9,2,8,0,20"}).status, 0);
    const auto brep = brep_of(folder / "out.ml");
    EXPECT_EQ(brep["regions"], 2);
    EXPECT_NEAR(total_volume(brep), 8 * 6 * 20, 1e-9);
    EXPECT_EQ(brep["features"]["boundary"], 6);
    EXPECT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--box", "1,9,2"}).status, 2);
    EXPECT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--box", "9,1,2,8,0,20"}).status, 2);
}

TEST(SurfaceRepair, ARecipeGivesTheSameBytesAgain) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    ASSERT_EQ(
        run_geomend({"repair", folder / "in.ts", "-o", folder / "a.ml", "--max-gap", "0.4", "--write-recipe", folder / "r.toml"}).status,
        0);
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "b.ml", "--recipe", folder / "r.toml"}).status, 0);
    EXPECT_EQ(read_file(folder / "a.ml"), read_file(folder / "b.ml"));
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "c.ml", "--max-gap", "0.4", "--threads", "1"}).status, 0);
    EXPECT_EQ(read_file(folder / "a.ml"), read_file(folder / "c.ml"));
}

TEST(SurfaceRepair, ADecisionOfTheRecipeComesBeforeVotes) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    write_file(folder / "r.toml", "steps = [\"close\"]\nmax_gap = 0.4\n[[contact]]\nborder = \"side_0\"\ndecision = \"leave\"\n");
    const auto run =
        run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--recipe", folder / "r.toml", "--json", "--keep-invalid"});
    const auto j = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_TRUE(j.contains("contacts")) << run.out << run.err;
    std::size_t own = 0, closed = 0;
    for (const auto& contact : j["contacts"]) {
        if (contact["border"] == "side_0") {
            EXPECT_EQ(contact["decision"], "left");
            ++own;
        } else {
            closed += contact["decision"] == "closed" ? 1u : 0u;
        }
    }
    EXPECT_EQ(own, 4u);
    EXPECT_EQ(closed, 20u);
}

TEST(SurfaceRepair, AMisspeltRecipeIsRefusedWithItsLine) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    for (const char* text : {"steps = [\"cut\"]\nmax_gapp = 3\n", "steps = [\"cut\"]\nmax_gap = -3\n", "steps = [\"cut\"]\nmax_gap =\n",
                             "steps = [\"cut\",\n\"glue\"]\n", "steps = [\"cut\"]\nbox = [1, 2]\n", "a = 1\n[[contact]]\non = \"x\"\n"}) {
        write_file(folder / "r.toml", text);
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--recipe", folder / "r.toml"});
        EXPECT_EQ(run.status, 2) << text;
        EXPECT_NE(run.err.find("r.toml:"), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.ml"));
    }
}

TEST(SurfaceRepair, AReportOrRecipeInThePlaceOfAnInputOrTheResultIsRefused) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    const std::string in = folder / "in.ts", before = read_file(in);
    EXPECT_EQ(run_geomend({"repair", in, "-o", folder / "out.ml", "--max-gap", "0.4", "--write-recipe", in}).status, 2);
    EXPECT_EQ(read_file(in), before);
    EXPECT_EQ(run_geomend({"repair", in, "-o", folder / "o.html", "--to", "gocad-ml", "--report", folder / "o.html"}).status, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "o.html"));
}

TEST(SurfaceRepair, AWeldThatWouldLeaveNothingOfASurfaceIsUndone) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "weld", "--tolerance", "50", "--json"});
    const auto j = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_TRUE(j.contains("steps")) << run.out << run.err;
    EXPECT_EQ(j["steps"][0]["kept"], false) << run.out;
}

TEST(SurfaceRepair, WhatDidNotCloseIsNoValidResultWithoutRegions) {
    const TemporaryFolder folder;
    const auto model = folder / "model.ml";
    // A box by its role, of which a side is missing.
    std::string open = cube_of_squares(0);
    open.erase(open.rfind("GOCAD TSurf"));
    std::string with_roles;
    for (std::size_t at = 0, next = 0; next != std::string::npos; at = next) {
        next = open.find("TFACE", at + 1);
        with_roles += open.substr(at, next - at);
        if (next != std::string::npos) with_roles += "GEOLOGICAL_TYPE boundary\n";
    }
    write_file(folder / "in.ts", with_roles);
    ASSERT_EQ(run_geomend({"validate", folder / "in.ts"}).status, 1);
    EXPECT_EQ(run_geomend({"repair", folder / "in.ts", "-o", model}).status, 6);
    EXPECT_FALSE(std::filesystem::exists(model));
    // Where it can be closed it is, also into a file that holds no regions.
    write_file(folder / "in.ts", with_roles + tsurf("lid", {{-1, -1, 10}, {11, -1, 10}, {11, 11, 10}, {-1, 11, 10}}, halves));
    EXPECT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "closed.ts"}).status, 0);
}

TEST(SurfaceRepair, ADryRunWritesNothing) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--max-gap", "0.4", "--dry-run"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("close"), std::string::npos) << run.out;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ml"));
}

TEST(SurfaceRepair, AStepThatMovesTooFarIsUndone) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", cube_of_squares(0.2));
    const auto run = run_geomend(
        {"repair", folder / "in.ts", "-o", folder / "out.ml", "--max-gap", "0.4", "--max-displacement", "0.1", "--keep-invalid", "--json"});
    const auto j = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_TRUE(j.contains("steps")) << run.out << run.err;
    bool undone = false;
    for (const auto& step : j["steps"])
        undone |= step["name"] == "close" && step["kept"] == false && !step["why"].get<std::string>().empty();
    EXPECT_TRUE(undone) << run.out;
}

TEST(SurfaceRepair, AMissingTriangleOfAClosedSurfaceIsFilled) {
    const TemporaryFolder folder;
    // An octahedron with seven of its eight faces.
    const std::vector<Point> points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const Triangles faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}};
    write_file(folder / "in.ts", tsurf("shell", points, faces));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--steps", "holes,rebuild"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const auto brep = brep_of(folder / "out.ml");
    EXPECT_EQ(brep["triangles"], 8);
    EXPECT_NEAR(total_volume(brep), 4.0 / 3, 1e-12);
}

/// The six sides of a cube of 30, each of n x n squares, without those of the top that `is_missing` tells of.
template <class IsMissing>
std::string cube_with_holes(int n, const IsMissing& is_missing) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
        for (int high = 0; high < 2; ++high) {
            std::vector<Point> points;
            Triangles triangles;
            for (int j = 0; j <= n; ++j) {
                for (int i = 0; i <= n; ++i) {
                    Point p{};
                    p[static_cast<std::size_t>(axis)] = 30.0 * high;
                    p[static_cast<std::size_t>((axis + 1) % 3)] = 30.0 * i / n;
                    p[static_cast<std::size_t>((axis + 2) % 3)] = 30.0 * j / n;
                    points.push_back(p);
                    if (i == n || j == n || (axis == 2 && high == 1 && is_missing(i, j))) continue;
                    const int a = i + j * (n + 1);
                    triangles.push_back({a, a + 1, a + n + 2});
                    triangles.push_back({a, a + n + 2, a + n + 1});
                }
            }
            text += tsurf("side_" + std::to_string(2 * axis + high), points, triangles);
        }
    }
    return text;
}

TEST(SurfaceRepair, TheOnlyHoleOfASideAndHolesOfOneSizeAreFilled) {
    const auto one = [](int i, int j) { return i == 4 && j == 5; };
    const auto several = [](int i, int j) { return i % 3 == 1 && j % 3 == 1; };
    const TemporaryFolder folder;
    write_file(folder / "one.ts", cube_with_holes(20, one));
    write_file(folder / "several.ts", cube_with_holes(20, several));
    for (const char* name : {"one", "several"}) {
        const std::string in = folder / (std::string(name) + ".ts"), out = folder / (std::string(name) + ".ml");
        const auto run = run_geomend({"repair", in, "-o", out, "--step", "holes", "--max-gap", "4"});
        EXPECT_EQ(run.status, 0) << name << run.out << run.err;
        EXPECT_NEAR(total_volume(brep_of(out)), 27000, 1e-6) << name;
        run_geomend({"repair", in, "-o", out, "--step", "holes", "--max-gap", "2"});
        EXPECT_EQ(brep_of(out)["regions"], 0) << "half the way around each is 3, wider than the limit";
    }
}

TEST(SurfaceRepair, TheBorderOfAnOpenSheetIsNoHole) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts",
               tsurf("sheet", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.2}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
    EXPECT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "holes", "--max-gap", "100"}).status, 0);
    EXPECT_EQ(info(folder / "out.ts")["objects"][0]["counts"]["triangles"], 4);
}

TEST(SurfaceRepair, DoublesAndTrianglesWithoutAreaAreRemoved) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", tsurf("s", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0, 0}},
                                       {{0, 1, 2}, {0, 2, 3}, {2, 0, 1}, {0, 4, 1}, {3, 3, 0}}));
    EXPECT_EQ(run_geomend({"validate", folder / "in.ts"}).status, 1);
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(info(folder / "out.ts")["objects"][0]["counts"]["triangles"], 2);
}

TEST(SurfaceRepair, ATriangleFlatterThanTheToleranceIsMendedByWhatItsFindingNames) {
    const TemporaryFolder folder;
    // A cube; on its top a vertex lies five tenths of a micrometre from an edge, on the surface's side of it.
    const std::vector<Point> points = {{0, 0, 0},   {10, 0, 0},   {10, 10, 0}, {0, 10, 0},   {0, 0, 10},
                                       {10, 0, 10}, {10, 10, 10}, {0, 10, 10}, {5, 5e-7, 10}};
    const Triangles faces = {{0, 2, 1}, {0, 3, 2}, {4, 5, 8}, {4, 8, 7}, {8, 6, 7}, {8, 5, 6}, {0, 1, 5},
                             {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    write_file(folder / "in.ts", tsurf("cube", points, faces));
    const auto codes = [&](const std::string& file) {
        std::vector<std::string> all;
        const auto report = nlohmann::json::parse(run_geomend({"validate", "--json", folder / file}).out);
        for (const auto& f : report["files"][0]["findings"]) all.push_back(f["code"]);
        return all;
    };
    EXPECT_TRUE(std::ranges::count(codes("in.ts"), "M03") == 1);
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_TRUE(codes("out.ts").empty());
}

}  // namespace
}  // namespace geomend
