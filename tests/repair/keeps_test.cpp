// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "made_boxes.h"
#include "support/program.h"

// What a repair may not do: lose a region, call valid what is not, make worse what it cannot mend.

namespace geomend {
namespace {

using test::box_text;
using test::info;
using test::level;
using test::run_geomend;
using test::Sheet;
using test::TemporaryFolder;
using test::tsurf_text;
using test::write_file;

std::vector<double> volumes_in(const std::string& file) {
    std::vector<double> volumes;
    const nlohmann::json all = info(file);
    for (const auto& region : all["brep"]["region_volumes"]) volumes.push_back(region.value("volume", -1.0));
    std::ranges::sort(volumes);
    return volumes;
}

void expect_volumes(const std::string& file, std::vector<double> right, double share = 1e-9) {
    const auto volumes = volumes_in(file);
    ASSERT_EQ(volumes.size(), right.size());
    std::ranges::sort(right);
    for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(volumes[i], right[i], share * right[i]);
}

nlohmann::json repaired(const TemporaryFolder& folder, const std::string& text, std::vector<std::string> options, int status) {
    write_file(folder / "in.ts", text);
    std::vector<std::string> words{"repair", folder / "in.ts", "-o", folder / "out.ml", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const auto run = run_geomend(words);
    EXPECT_EQ(run.status, status) << run.out << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
}

const Sheet fault{"F", {5, 0, 0}, {0, 10, 0}, {0, 0, 10}, 6, "fault", {}};

TEST(Overlaps, AHorizonThatLiesInTheTopOfItsBoxBecomesAPartOfIt) {
    const TemporaryFolder folder;
    for (const int n : {4, 5}) {  // the triangles of the side, and others
        const auto j = repaired(folder, box_text() + tsurf_text(level("H", 10, n)) + tsurf_text(level("H2", 5)), {}, 0);
        expect_volumes(folder / "out.ml", {500, 500});
        EXPECT_NE(j.dump().find("all of 'H' in 'side_5' left out"), std::string::npos) << j["steps"].dump();
    }
}

TEST(Overlaps, ASurfaceThatIsThereTwiceBecomesOne) {
    const TemporaryFolder folder;
    for (const int n : {5, 7}) {
        repaired(folder, box_text() + tsurf_text(level("H2", 5)) + tsurf_text(level("H3", 5, n)), {}, 0);
        expect_volumes(folder / "out.ml", {500, 500});
    }
    repaired(folder, box_text() + box_text(), {}, 0);
    expect_volumes(folder / "out.ml", {1000});
}

TEST(Overlaps, OfAPartThatOverlapsThatStaysWhichHangsTogetherWithMoreAroundIt) {
    const TemporaryFolder folder;
    // A horizon that rises into the top and runs along it for the last fifth of its way.
    Sheet rising = level("H", 5, 5);
    rising.move = [](const Vec3& p) { return Vec3{p[0], p[1], p[0] < 7 ? 5.0 : 10.0}; };
    const auto j = repaired(folder, box_text() + tsurf_text(rising), {}, 0);
    expect_volumes(folder / "out.ml", {350, 650});
    EXPECT_NE(j.dump().find("of 'H' in 'side_5' left out"), std::string::npos) << j["steps"].dump();
}

TEST(Verdict, IsByTheRuleAlsoWhereALargerToleranceIsGiven) {
    const TemporaryFolder folder;
    // Judged by 0.3 the shaken box closes; nothing welds it.
    const std::string box = box_text(0.05);
    write_file(folder / "in.ts", box);
    ASSERT_EQ(run_geomend({"validate", folder / "in.ts", "--tolerance", "0.3"}).status, 0);
    const auto j = repaired(folder, box, {"--tolerance", "0.3", "--steps", "clean"}, 6);
    EXPECT_EQ(j["report"]["files"][0]["valid"], false);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ml"));
    // Welded by it, it is sound by any.
    repaired(folder, box, {"--tolerance", "0.3"}, 0);
    EXPECT_EQ(volumes_in(folder / "out.ml").size(), 1u);
    EXPECT_EQ(run_geomend({"validate", folder / "out.ml"}).status, 0);
}

TEST(Verdict, IsNeverValidWhereABoxHasNoRegion) {
    const TemporaryFolder folder;
    const auto with_roles = repaired(folder, box_text(0.05), {}, 6);
    EXPECT_EQ(with_roles["report"]["files"][0]["valid"], false);
    // Without roles nobody says that it should close; but it was not sound before, and has no region.
    const auto without = repaired(folder, box_text(0.05, {}), {}, 0);
    EXPECT_FALSE(without["report"]["files"][0].contains("valid")) << without["report"].dump();
}

TEST(DefaultPlan, WeldsByTheToleranceAtWhichBordersAgree) {
    const TemporaryFolder folder;
    for (const double shaken : {0.0005, 0.001, 0.002}) {
        const auto j = repaired(folder, box_text(shaken), {}, 0);
        const auto volumes = volumes_in(folder / "out.ml");
        ASSERT_EQ(volumes.size(), 1u) << shaken;
        EXPECT_NEAR(volumes[0], 1000, 1000 * shaken);
        EXPECT_NE(j["steps"].dump().find("borders agree within"), std::string::npos);
    }
}

TEST(DefaultPlan, NamesAToleranceThatIsTooLargeToBeTakenUnasked) {
    const TemporaryFolder folder;
    const auto j = repaired(folder, box_text(0.05), {}, 6);
    ASSERT_TRUE(j["report"]["files"][0].contains("closes_with")) << j["report"].dump();
    const double tolerance = j["report"]["files"][0]["closes_with"]["tolerance"];
    repaired(folder, box_text(0.05), {"--tolerance", std::to_string(tolerance)}, 0);
}

TEST(DefaultPlan, NamesAGapThatIsTooLargeToBeClosedUnasked) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box_gap.ml";
    const auto run = run_geomend({"repair", sample, "-o", folder / "out.ml", "--json"});
    EXPECT_EQ(run.status, 6) << run.err;
    const auto closes = nlohmann::json::parse(run.out)["report"]["files"][0]["closes_with"];
    ASSERT_TRUE(closes.contains("max_gap")) << run.out;
    EXPECT_FALSE(closes.contains("tolerance"));
    const double gap = closes["max_gap"];
    EXPECT_NEAR(gap, 5.1, 1e-9) << "H1 ends 5 m before the fault, along itself 5.09";
    EXPECT_EQ(closes["message"], "borders stop short of surfaces by up to 5.1: with --max-gap 5.1 the model closes");
    EXPECT_EQ(run_geomend({"repair", sample, "-o", folder / "out.ml", "--max-gap", "5.1"}).status, 0);
    EXPECT_EQ(volumes_in(folder / "out.ml").size(), 6u);
    EXPECT_EQ(run_geomend({"repair", sample, "-o", folder / "none.ml", "--max-gap", "4"}).status, 6) << "less does not";
}

TEST(DefaultPlan, ClosesBordersBeforeItWeldsWhereThatIsBetter) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box_gap.ml";
    const auto run = run_geomend({"repair", sample, "-o", folder / "out.ml", "--max-gap", "20", "--write-recipe", folder / "r.toml"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(volumes_in(folder / "out.ml").size(), 6u);
    // The recipe has the plan that was taken.
    EXPECT_EQ(run_geomend({"repair", sample, "-o", folder / "again.ml", "--recipe", folder / "r.toml"}).status, 0);
    EXPECT_EQ(test::read_file(folder / "again.ml"), test::read_file(folder / "out.ml"));
}

TEST(Close, ABorderHalfOfWhichSticksThroughIsClosedWhereItStopsShort) {
    const TemporaryFolder folder;
    for (const double at_south : {4.95, 4.955, 4.965}) {
        Sheet half{"H",
                   {0, 0, 5},
                   {5, 0, 0},
                   {0, 10, 0},
                   8,
                   "top",
                   [&](const Vec3& p) {
                       return Vec3{p[0] / 5 * (at_south + 0.01 * p[1]), p[1], p[2]}; }};
        const auto j = repaired(folder, box_text() + tsurf_text(fault) + tsurf_text(half), {"--max-gap", "0.1"}, 0);
        expect_volumes(folder / "out.ml", {250, 250, 500});
        const auto own = std::ranges::find_if(j["contacts"], [](const auto& c) { return c["border"] == "H" && c["on"] == "F"; });
        ASSERT_NE(own, j["contacts"].end());
        EXPECT_EQ((*own)["decision"], "closed");
    }
}

// A border that is left says what lies near it all the same, and why that is not what it ends on.
TEST(Close, ABorderThatIsLeftSaysWhatLiesNearIt) {
    const TemporaryFolder folder;
    const Sheet wall{"W", {0, 0, 0}, {10, 0, 0}, {0, 0, 10}, 4, "fault", {}};
    const auto why_of = [&](const Sheet& sheet) {
        const auto j =
            repaired(folder, tsurf_text(wall) + tsurf_text(sheet), {"--steps", "close", "--max-gap", "0.5", "--keep-invalid"}, 0);
        std::string all;
        for (const auto& c : j["contacts"]) {
            if (c["border"] == "S" && c["on"] == "W") all += c["why"].get<std::string>() + "\n";
        }
        return all;
    };
    const auto has = [](const std::string& all, const char* part) { return all.find(part) != std::string::npos; };
    EXPECT_TRUE(has(why_of({"S", {2, 0.3, 2}, {5, 0, 0}, {0, 0, 5}, 4, "fault", {}}),
                    "the nearest one is 0.3 away, and both run along each other"));
    EXPECT_TRUE(has(why_of({"S", {10.4, -2, 2}, {4, 0.2, 0}, {0, 4, 4}, 4, "fault", {}}),
                    "the nearest one is 0.4 away, and is met at less than 10 degrees"))
        << "the wall ends where S begins";
    EXPECT_EQ(why_of({"S", {2, 3, 2}, {5, 0, 0}, {0, 0, 5}, 4, "fault", {}}), "");
}

// Faults far from each other are judged by the tolerance of the box when it is close around them, and so they must be mended by it:
// vertices of F lie beside the line where H cuts it.
// The result states the regions that were found: to a reader of it the horizon lies in one of them as it is meant to.
TEST(Regions, ThatASurfaceWithoutARoleFailsToPartAreToldAlsoWhereTheResultStatesThem) {
    const TemporaryFolder folder;
    Sheet shorter = level("H", 5, 5);
    shorter.role.clear();
    shorter.corner = {0.5, 0, 5};
    shorter.u = {9.5, 0, 0};
    const auto j = repaired(folder, box_text(0, "") + tsurf_text(shorter), {}, 0);
    const auto& findings = j["report"]["files"][0]["findings"];
    const auto told = std::ranges::find_if(findings, [](const auto& finding) { return finding["code"] == "B29"; });
    ASSERT_NE(told, findings.end()) << j;
    EXPECT_NE((*told)["message"].dump().find("ends freely along"), std::string::npos) << *told;
    // With the gap closed there is nothing to tell.
    const auto closed = repaired(folder, box_text(0, "") + tsurf_text(shorter), {"--max-gap", "0.6"}, 0);
    EXPECT_EQ(closed.dump().find("B29"), std::string::npos) << closed;
}

TEST(Box, WhatIsCutInItIsMendedByTheToleranceOfTheWhole) {
    const TemporaryFolder folder;
    Sheet far = fault;
    far.name = "far";
    far.corner[0] = 99;
    for (const double beside : {0.0, 2e-6, 4e-6, 7e-6}) {
        Sheet crossing = level("H", 5 + beside, 3);
        crossing.role = "fault";
        repaired(folder, tsurf_text(fault) + tsurf_text(crossing) + tsurf_text(far), {"--box", "-0.1,100.1,-0.1,10.1,-0.1,10.1"}, 0);
        expect_volumes(folder / "out.ml", {100.2 * 10.2 * 10.2});
    }
}

// Steep surfaces whose role is not said are no layers that a box could end at, however long they are.
TEST(Box, AroundFaultsAloneItHoldsAllOfThem) {
    const TemporaryFolder folder;
    Sheet first{"first", {0, 0, 0}, {100, 90, 0}, {0, 0, 10}, 6, "", {}};
    Sheet second{"second", {60, -30, 0}, {-20, 40, 0}, {0, 0, 10}, 4, "", {}};
    const auto j = repaired(folder, tsurf_text(first) + tsurf_text(second), {"--box", "auto"}, 0);
    EXPECT_NE(j["steps"].dump().find("x -1 .. 101, y -31.2 .. 91.2"), std::string::npos) << j["steps"].dump();
    EXPECT_EQ(j.dump().find("B16"), std::string::npos) << "nothing lies outside: " << j.dump();
}

TEST(Tails, WhatPartsRegionsStaysHoweverLargeTheGapGivenIs) {
    const TemporaryFolder folder;
    // A fault across the box, sticking out of it, and a horizon on one side of it that sticks through.
    Sheet wide = fault;
    wide.corner = {5, -0.2, -0.2};
    wide.u = {0, 10.4, 0};
    wide.v = {0, 0, 10.4};
    Sheet half = level("H", 5, 8);
    half.u = {5.2, 0, 0};
    const std::string model = box_text() + tsurf_text(wide) + tsurf_text(half);
    for (const char* gap : {"0.3", "1", "8", "1e9"}) {
        repaired(folder, model, {"--max-gap", gap}, 0);
        expect_volumes(folder / "out.ml", {250, 250, 500});
    }
}

// It would reach to a point that is no part of the surfaces, and hide how far off that is: the result was called valid.
TEST(Box, IsNotMadeAroundPointsThatLieFarOff) {
    const TemporaryFolder folder;
    Sheet spiked = level("H", 50, 20, 100);
    spiked.move = [](const Vec3& p) { return p == Vec3{20, 20, 50} ? Vec3{20, 20, 1e5} : p; };
    write_file(folder / "in.ts", tsurf_text(spiked) + tsurf_text(level("H2", 20, 20, 100)));
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--box", "auto"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("1 point lies far off, of 'H' at (20, 20, 100000)"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ml"));
}

// A fault that ends 6 above a horizon of 100 by 100: less than a thousandth of a model with a point, or a surface, far off.
TEST(Tails, AreMeasuredByWhatLiesTogetherWhateverLiesFarOff) {
    const TemporaryFolder folder;
    const Sheet high{"F", {52.5, 10, 20}, {0, 80, 0}, {0, 0, 36}, 12, "fault", {}};
    Sheet horizon = level("H", 50, 20, 100), spiked = horizon, far = level("far", 0, 4, 100), wide = level("wide", 0, 20, 1e6);
    spiked.move = [](const Vec3& p) { return p == Vec3{20, 20, 50} ? Vec3{20, 20, 1e5} : p; };
    far.corner[0] = 1e5;
    wide.corner[0] = 1e7;
    const auto area_of_fault = [&](const std::string& others, const std::vector<std::string>& more) {
        std::vector<std::string> options{"--keep-invalid", "--steps", more.empty() ? "cut,tails" : "box,cut,tails"};
        options.insert(options.end(), more.begin(), more.end());
        write_file(folder / "in.ts", tsurf_text(high) + others);
        std::vector<std::string> words{"repair", folder / "in.ts", "-o", folder / "out.ml"};
        words.insert(words.end(), options.begin(), options.end());
        const auto run = run_geomend(words);
        const nlohmann::json made = info(folder / "out.ml");
        double area = -1;
        for (const auto& object : made["objects"]) {
            if (object["name"] == "F") area = object["area"];
        }
        EXPECT_NE(area, -1) << run.out << run.err;
        return area;
    };
    EXPECT_NEAR(area_of_fault(tsurf_text(horizon), {"--box", "auto"}), 80 * 36, 1e-6);
    EXPECT_NEAR(area_of_fault(tsurf_text(spiked), {"--box", "-1,101,-1,101,0,1.1e5"}), 80 * 36, 1e-6) << "a stray point";
    EXPECT_NEAR(area_of_fault(tsurf_text(horizon) + tsurf_text(far), {"--box", "auto"}), 80 * 36, 1e-6) << "a surface far off";
    EXPECT_NEAR(area_of_fault(tsurf_text(horizon), {"--box", "-1e5,1e5,-1e5,1e5,-1e5,1e5"}), 80 * 36, 1e-6) << "a large box";
    EXPECT_NEAR(area_of_fault(tsurf_text(horizon) + tsurf_text(wide), {}), 80 * 36, 1e-6) << "another model in the same file";
}

TEST(Regions, ThatCellsPartAreStillPartedWithoutThem) {
    const TemporaryFolder folder;
    // Two tetrahedra, one above the other, in two volumes with no face between them.
    write_file(
        folder / "in.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"low\"\n3 2 \"high\"\n$EndPhysicalNames\n$Nodes\n5\n"
        "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n$EndNodes\n$Elements\n2\n1 4 2 1 1 1 3 2 5\n2 4 2 2 2 1 2 3 4\n$EndElements\n");
    const auto run = run_geomend({"repair", folder / "in.msh", "-o", folder / "out.ml", "--lossy"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    expect_volumes(folder / "out.ml", {1.0 / 6, 1.0 / 6});
}

TEST(Close, AnEdgeOverAConcaveHingeIsBroughtDownToItsFold) {
    const TemporaryFolder folder;
    // Euler 18: z = 0 for x <= 0, z = x for x >= 0; an edge of another surface stands over the fold as a chord.
    Sheet hinge{"C", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 8, {}, [](const Vec3& p) { return Vec3{p[0], p[1], std::max(0.0, p[0])}; }};
    const std::string chord = "GOCAD TSurf 1\nHEADER {\nname: V\n}\nTFACE\nVRTX 1 -1 0 0\nVRTX 2 1 0 1\nVRTX 3 0 0 8\nTRGL 1 2 3\nEND\n";
    write_file(folder / "in.ts", tsurf_text(hinge) + chord);
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ts", "--steps", "close,cut,tails", "--max-gap", "0.7"});
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    // V reaches down to the fold: all of the triangle between the chord and the hinge, of 0.5, is there now.
    const nlohmann::json all = info(folder / "out.ts");
    double area = 0;
    for (const auto& object : all["objects"]) area += object["name"] == "V" ? object["area"].get<double>() : 0;
    EXPECT_NEAR(area, 7.5 + 0.5, 1e-9);
}

TEST(Close, AGapLargerThanTheModelMovesNothingOutOfIt) {
    const TemporaryFolder folder;
    Sheet shorter = level("H", 5, 5);
    shorter.u = {9, 0, 0};
    const auto j = repaired(folder, box_text() + tsurf_text(shorter), {"--max-gap", "1e9", "--keep-invalid"}, 0);
    for (const auto& step : j["steps"]) EXPECT_LE(step["max_displacement"].get<double>(), 10) << step;
    expect_volumes(folder / "out.ml", {500, 500});
}

/// Two surfaces of triangles that lie within some 1e-7 of the size of each other, corners and edges in part within 1e-4.
std::string tangled_text() {
    const auto surface = [](const std::string& name, const std::string& vertices, const std::string& triangles) {
        return "GOCAD TSurf 1\nHEADER {\nname:" + name + "\n}\nTFACE\n" + vertices + triangles + "END\n";
    };
    return surface("s0",
                   "VRTX 1 1.000000001 0 1e-7\nVRTX 2 0 0 1.0000001\nVRTX 3 1.0001 1.000000001 1\nVRTX 4 1 0 1\n"
                   "VRTX 5 1.0001 1.0001 1.000000001\n",
                   "TRGL 4 2 5\nTRGL 2 1 3\n") +
           surface("s1",
                   "VRTX 1 1.0001 1e-7 1.000000001\nVRTX 2 0 1 1.0000001\nVRTX 3 1 1.0000001 1\nVRTX 4 1.0000001 0 1.000000001\n"
                   "VRTX 5 1.0001 1.0000001 1.0001\nVRTX 6 1 0.0001 0\nVRTX 7 1.0001 1 1\nVRTX 8 1 1 1\nVRTX 9 1 1e-7 0\n"
                   "VRTX 10 0.0001 1 1\nVRTX 11 1e-9 0 1.0001\n",
                   "TRGL 1 7 3\nTRGL 11 8 9\nTRGL 5 9 6\nTRGL 4 2 10\nTRGL 5 2 4\nTRGL 1 11 9\n");
}

// What a weld leaves unsettled has many more triangles, and would have many more again if it were cut again.
TEST(Weld, EndsWhereNothingSettles) {
    const TemporaryFolder folder;
    write_file(folder / "in.ts", tangled_text());
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
    EXPECT_TRUE(run.status == 0 || run.status == 6) << run.status << run.out << run.err;
}

// A cube of side 10 without two triangles that have one corner in common.
TEST(Holes, ThatTouchInAPointAreFoundAndFilled) {
    const TemporaryFolder folder;
    std::string text = "GOCAD TSurf 1\nHEADER {\nname:cube\n}\nTFACE\n";
    for (int v = 0; v < 8; ++v) {
        text += "VRTX " + std::to_string(v + 1);
        for (int axis = 0; axis < 3; ++axis) text += (v >> axis) % 2 != 0 ? " 10" : " 0";
        text += '\n';
    }
    // Missing: 1 3 4 of the bottom and 1 2 6 of a side.
    for (const char* t : {"1 4 2", "5 6 8", "5 8 7", "1 6 5", "3 7 8", "3 8 4", "1 5 7", "1 7 3", "2 4 8", "2 8 6"})
        text += std::string("TRGL ") + t + '\n';
    write_file(folder / "in.ts", text + "END\n");
    const auto checked = run_geomend({"validate", folder / "in.ts"});
    EXPECT_NE(checked.out.find("B29"), std::string::npos) << "it is open, and says so\n" << checked.out;
    const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml", "--max-gap", "40"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    expect_volumes(folder / "out.ml", {1000});
}

/// A box of side 10 as one TSurf, its lid in two halves, and a horizon across it. Each side is a TFACE with points of its own,
/// or all are triangles over the same points.
std::string box_and_horizon(bool sides_apart) {
    constexpr std::array<std::array<const char*, 4>, 7> sides{{{"0 0 0", "0 10 0", "10 10 0", "10 0 0"},
                                                               {"0 0 0", "10 0 0", "10 0 10", "0 0 10"},
                                                               {"10 0 0", "10 10 0", "10 10 10", "10 0 10"},
                                                               {"10 10 0", "0 10 0", "0 10 10", "10 10 10"},
                                                               {"0 10 0", "0 0 0", "0 0 10", "0 10 10"},
                                                               {"0 0 10", "4 0 10", "4 10 10", "0 10 10"},
                                                               {"4 0 10", "10 0 10", "10 10 10", "4 10 10"}}};
    std::string text = "GOCAD TSurf 1\nHEADER {\nname:box\n}\n", triangles;
    if (!sides_apart) text += "TFACE\n";
    std::map<std::string, int> numbers;
    int count = 0;
    for (const auto& side : sides) {
        if (sides_apart) {
            numbers.clear();
            text += triangles + "TFACE\n";
            triangles.clear();
        }
        for (const char* corner : side) {
            if (!numbers.try_emplace(corner, count + 1).second) continue;
            text += "VRTX " + std::to_string(++count) + ' ' + corner + '\n';
        }
        for (const auto& [a, b, c] : {std::array{0u, 1u, 2u}, std::array{0u, 2u, 3u}}) {
            triangles += "TRGL";
            for (const unsigned k : {a, b, c}) triangles += ' ' + std::to_string(numbers.at(side[k]));
            triangles += '\n';
        }
    }
    return text + triangles + "END\n" + tsurf_text(level("horizon", 5));
}

// What a surface has borders of, stays a line, its ends corners, also where two of its pieces lie in one plane; where it is stated whole
// nothing says where it should be parted, and it is only where others meet it.
TEST(Lines, AreTheBordersThatPiecesComeWith) {
    const TemporaryFolder folder;
    for (const bool sides_apart : {true, false}) {
        write_file(folder / "in.ts", box_and_horizon(sides_apart));
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
        ASSERT_EQ(run.status, 0) << run.out << run.err;
        const auto brep = info(folder / "out.ml")["brep"];
        std::array<int, 4> sizes{};
        std::size_t i = 0;
        for (const char* key : {"corners", "lines", "surfaces", "regions"}) sizes[i++] = brep[key].get<int>();
        const std::array<int, 4> apart{14, 23, 12, 2}, whole{1, 1, 3, 2};
        EXPECT_EQ(sizes, sides_apart ? apart : whole);
        expect_volumes(folder / "out.ml", {500, 500});
    }
}

}  // namespace
}  // namespace geomend
