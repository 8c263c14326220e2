// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <sstream>

#include "support/program.h"

// The step scars from the command line: traces of lines that no surface needs any more.

namespace geomend {
namespace {

using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

/// A surface of several parts; each a list of nodes and triangles of its own.
struct Part {
    std::vector<std::array<double, 3>> nodes;
    std::vector<std::array<int, 3>> triangles;
};

std::string tsurf(const std::string& name, const std::vector<Part>& parts) {
    std::ostringstream text;
    text.precision(17);
    text << "GOCAD TSurf 1\nHEADER {\nname:" << name << "\n}\n";
    int first = 1;
    for (const Part& part : parts) {
        text << "TFACE\n";
        for (std::size_t i = 0; i < part.nodes.size(); ++i)
            text << "VRTX " << first + static_cast<int>(i) << ' ' << part.nodes[i][0] << ' ' << part.nodes[i][1] << ' ' << part.nodes[i][2]
                 << '\n';
        for (const auto& t : part.triangles) text << "TRGL " << first + t[0] << ' ' << first + t[1] << ' ' << first + t[2] << '\n';
        first += static_cast<int>(part.nodes.size());
    }
    text << "END\n";
    return text.str();
}

std::array<int, 2> nodes_and_triangles(const std::string& file, const std::string& surface) {
    std::istringstream lines(test::read_file(file));
    std::array<int, 2> count{};
    bool is_it = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("name:")) is_it = line == "name:" + surface;
        if (!is_it) continue;
        count[0] += line.starts_with("VRTX ") || line.starts_with("ATOM ") ? 1 : 0;
        count[1] += line.starts_with("TRGL ") ? 1 : 0;
    }
    return count;
}

/// Two halves of a square, 2 x 1 each, that meet at x = 2 with a node in the middle; the right one leans by some height at its end.
std::vector<Part> halves(double height) {
    return {{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}}},
            {{{2, 0, 0}, {4, 0, height}, {4, 2, height}, {2, 2, 0}, {2, 1, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}}}};
}

TEST(Scars, LipsInOnePlaneAreStitchedAndTheirInnerNodeGoes) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", tsurf("sheet", halves(0)));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "scars"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(nodes_and_triangles(folder / "out.ts", "sheet"), (std::array{6, 4})) << "extremities on the border stay";
}

// N. Euler's acceptance test 11, from file to file: lips at 140 degrees are stitched, at 130 they are not.
TEST(Scars, LipsAreStitchedUpToTheAngleOnly) {
    const TemporaryFolder folder;
    const double pi = 3.14159265358979323846;
    for (const auto& [degrees, joined] : {std::pair{140., true}, {130., false}}) {
        auto parts = halves(0);
        for (auto& p : parts[1].nodes) {
            const double along = p[0] - 2, bend = pi - degrees * pi / 180;
            p = {2 + along * std::cos(bend), p[1], along * std::sin(bend)};
        }
        write_file(folder / "in.ts", tsurf("sheet", parts));
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "scars"});
        ASSERT_EQ(run.status, 0) << run.out << run.err;
        EXPECT_EQ(run.out.find("stitched") != std::string::npos, joined) << run.out;
        EXPECT_EQ(run.out.find("where the surface bends") != std::string::npos, !joined) << run.out;
    }
}

TEST(Scars, TheAngleCanBeGivenInARecipe) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", tsurf("sheet", halves(0.5)));
    write_file(folder / "recipe.toml", "steps = [\"scars\"]\nscar_angle = 5\n");
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--recipe", folder / "recipe.toml"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("where the surface bends"), std::string::npos) << run.out;
}

TEST(Scars, WhatATailCutComesBackAsItWasRead) {
    const TemporaryFolder folder;
    const std::string floor = tsurf("floor", {{{{0, 0, 0}, {10, 0, 0}, {10, 10, 1}, {0, 10, 1}}, {{0, 1, 2}, {0, 2, 3}}}});
    // The wall cuts the floor from y = -1 to 9.9; the other one, at y = 9.8, ends it, and the floor behind is cut for nothing.
    const std::string wall = tsurf("wall", {{{{3, -1, -5}, {3, 9.9, -5}, {3, 9.9, 5}, {3, -1, 5}}, {{0, 1, 2}, {0, 2, 3}}}});
    const std::string stop = tsurf("stop", {{{{-1, 9.8, -6}, {11, 9.8, -6}, {11, 9.8, 6}, {-1, 9.8, 6}}, {{0, 1, 2}, {0, 2, 3}}}});
    write_file(folder / "in.ts", floor + wall + stop);
    const auto repair = [&](const std::string& steps) {
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", steps, "--max-gap", "0.15"});
        EXPECT_EQ(run.status, 0) << run.out << run.err;
        return nodes_and_triangles(folder / "out.ts", "floor");
    };
    const auto cut = repair("cut,tails"), mended = repair("cut,tails,scars");
    EXPECT_LT(mended[1], cut[1]);
    EXPECT_LT(mended[0], cut[0]);
}

TEST(Scars, LinesThatSurfacesNeedStay) {
    const TemporaryFolder folder;
    const std::string floor = tsurf("floor", {{{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}}});
    const std::string wall = tsurf("wall", {{{{3, -1, -5}, {3, 9, -5}, {3, 9, 5}, {3, -1, 5}}, {{0, 1, 2}, {0, 2, 3}}}});
    write_file(folder / "in.ts", floor + wall);
    ASSERT_EQ(run_geomend({"repair", folder / "in.ts", "-o", folder / "cut.ts", "--steps", "cut"}).status, 0);
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "cut,scars"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(test::read_file(folder / "cut.ts"), test::read_file(folder / "out.ts"));
}

}  // namespace
}  // namespace geomend
