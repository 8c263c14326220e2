// SPDX-License-Identifier: AGPL-3.0-or-later
// N. Euler's acceptance tests 19 and 20 of the constrained cut, from file to file: surfaces that stop short of what they end on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/vectors.h"
#include "made_boxes.h"
#include "support/program.h"

namespace geomend {
namespace {

using test::run_geomend;
using test::Sheet;
using test::TemporaryFolder;
using test::tsurf_text;
using test::write_file;

struct Surface {
    std::set<Vec3> vertices;
    std::vector<std::array<Vec3, 3>> triangles;
};

/// Surfaces of a Gocad file by their names, parts of one name together.
std::map<std::string, Surface> surfaces_in(const std::string& path) {
    std::map<std::string, Surface> all;
    std::istringstream in(test::read_file(path));
    std::string name, word;
    std::map<int, Vec3> places;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        words >> word;
        if (line.starts_with("name:")) name = line.substr(line.find_first_not_of(" \"", 5)), places.clear();
        while (!name.empty() && (name.back() == '"' || name.back() == '\r')) name.pop_back();
        int a = 0, b = 0, c = 0;
        Vec3 p{};
        if (word == "VRTX" && words >> a >> p[0] >> p[1] >> p[2]) places[a] = p;
        if (word == "ATOM" && words >> a >> b) places[a] = places.at(b);
        if (word == "TRGL" && words >> a >> b >> c) {
            all[name].triangles.push_back({places.at(a), places.at(b), places.at(c)});
            for (const int v : {a, b, c}) all[name].vertices.insert(places.at(v));
        }
    }
    return all;
}

/// Edges that one triangle alone has.
std::vector<std::array<Vec3, 2>> free_edges(const Surface& surface) {
    std::map<std::array<Vec3, 2>, int> uses;
    for (const auto& t : surface.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            ++uses[{low, high}];
        }
    }
    std::vector<std::array<Vec3, 2>> free;
    for (const auto& [edge, n] : uses) {
        if (n == 1) free.push_back(edge);
    }
    return free;
}

/// An upright wall x = 0.37 whose lower border stops 0.05 above z = 0, over one edge or many.
Sheet wall(int n) { return {"V", {0.37, -3, 0.05}, {0, 6, 0}, {0, 0, 4}, n, {}, {}}; }

std::map<std::string, Surface> closed(const TemporaryFolder& folder, const std::string& text, const std::string& gap, int status = 0) {
    write_file(folder / "in.ts", text);
    const auto run = run_geomend(
        {"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "close,cut,tails", "--max-gap", gap, "--keep-invalid"});
    EXPECT_EQ(run.status, status) << run.err;
    return surfaces_in(folder / "out.ts");
}

/// The border of V at z = 0 is in its plane, up to the grid of the cut, goes from y = -3 to 3 in one piece, and each of its edges is one of
/// the controller.
void expect_line_in_plane(const std::map<std::string, Surface>& model) {
    ASSERT_TRUE(model.contains("V") && model.contains("C"));
    double length = 0;
    std::set<std::array<Vec3, 2>> of_controller;
    for (const auto& t : model.at("C").triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            of_controller.insert({low, high});
        }
    }
    for (const Vec3& p : model.at("V").vertices) EXPECT_NEAR(p[0], 0.37, 1e-8);
    for (const auto& edge : free_edges(model.at("V"))) {
        if (edge[0][2] > 1e-9 || edge[1][2] > 1e-9) continue;
        EXPECT_TRUE(of_controller.contains(edge)) << "an edge of one surface alone";
        length += std::abs(edge[1][1] - edge[0][1]);
    }
    EXPECT_NEAR(length, 6, 1e-9);
}

TEST(Euler19, TheLineStaysInThePlaneOfTheBorderWhateverTheControllersTriangles) {
    const TemporaryFolder folder;
    // Long thin triangles, whose shortest way by neighbours leaves the plane.
    const auto sheared = [](const Vec3& p) { return Vec3{p[0] + 1.7 * p[1], p[1], p[2]}; };
    for (const int n : {1, 5}) {
        const Sheet fine{"C", {-12, -4, 0}, {24, 0, 0}, {0, 8, 0}, 11, {}, sheared};
        expect_line_in_plane(closed(folder, tsurf_text(fine) + tsurf_text(wall(n)), "0.1"));
    }
}

TEST(Euler19, APlaneThroughVerticesOfTheControllerFindsItsWay) {
    const TemporaryFolder folder;
    // A row of its vertices lies in the plane, and diagonals end there.
    const Sheet aligned{"C", {0.37 - 4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 8, {}, {}};
    for (const int n : {1, 6}) expect_line_in_plane(closed(folder, tsurf_text(aligned) + tsurf_text(wall(n)), "0.1"));
}

TEST(Euler19, AControllerInTwoPiecesGivesNoLineAcrossTheGap) {
    const TemporaryFolder folder;
    const Sheet left{"C", {-4, -4, 0}, {8, 0, 0}, {0, 3, 0}, 4, {}, {}}, right{"C2", {-4, 1, 0}, {8, 0, 0}, {0, 3, 0}, 4, {}, {}};
    const auto model = closed(folder, tsurf_text(left) + tsurf_text(right) + tsurf_text(wall(12)), "0.1");
    ASSERT_TRUE(model.contains("C") && model.contains("C2"));
    for (const char* name : {"C", "C2"}) {
        for (const Vec3& p : model.at(name).vertices) EXPECT_TRUE(std::abs(p[2]) < 1e-9 && (p[1] <= -1 + 1e-9 || p[1] >= 1 - 1e-9));
    }
}

// A horizon that stops short of the corner where Fault2 abuts on Fault1: its tip becomes the one node that all three have.
TEST(Euler20, AHorizonsTipAtTheJunctionOfTwoFaultsIsOneNode) {
    const TemporaryFolder folder;
    const std::string faults = tsurf_text({"Fault1", {0, -5, -5}, {0, 10, 0}, {0, 0, 10}, 7, "fault", {}}) +
                               tsurf_text({"Fault2", {0, 0, -5}, {5, 0, 0}, {0, 0, 10}, 6, "fault", {}});
    write_file(folder / "in.ts", faults + tsurf_text({"H", {0.02, 0.03, 0.1}, {4, 0, 0}, {0, 4, 0}, 5, "top", {}}));
    for (const char* tolerance : {"1e-8", "1e-7", "1e-6", "1e-5", "1e-4", "1e-3", "1e-2"}) {
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "close,cut,tails", "--max-gap",
                                      "0.08", "--tolerance", tolerance, "--keep-invalid"});
        ASSERT_EQ(run.status, 0) << tolerance << run.err;
        const auto model = surfaces_in(folder / "out.ts");
        std::map<Vec3, std::set<std::string>> surfaces_at;
        for (const auto& [name, surface] : model) {
            for (const Vec3& p : surface.vertices) surfaces_at[p].insert(name);
        }
        std::vector<Vec3> common;
        for (const auto& [p, names] : surfaces_at) {
            if (names.size() == 3) common.push_back(p);
        }
        ASSERT_EQ(common.size(), 1u) << tolerance << ": " << testing::PrintToString(common);
        const Vec3 off = minus(common[0], Vec3{0, 0, 0.1});
        EXPECT_LE(std::sqrt(dot(off, off)), std::stod(tolerance)) << tolerance;
        for (const auto& [p, names] : surfaces_at) {
            const Vec3 d = minus(p, common[0]);
            EXPECT_TRUE(p == common[0] || std::sqrt(dot(d, d)) >= 0.99 * std::stod(tolerance)) << "a node next to it, " << tolerance;
        }
    }
}

}  // namespace
}  // namespace geomend
