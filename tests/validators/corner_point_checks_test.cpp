// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/wording.h"
#include "validators/checks_testing.h"

namespace geomend {
namespace {

using namespace testing;
using Codes = std::set<std::string>;

TEST(Checks, FindNothingInBricks) { EXPECT_EQ(codes_of(brick_grid(4, 3, 2)), Codes{}); }

TEST(Checks, C01TellsArraysOfTheWrongLengthAndThenNothingElse) {
    CornerPointGrid grid = brick_grid(2, 2, 2);
    grid.depths.pop_back();
    const auto found = findings_of(grid);
    ASSERT_EQ(codes_of(found), Codes{"C01 error"});
    EXPECT_NE(found[0].message.find("expected 64 values, found 63"), std::string::npos) << found[0].message;
    grid = brick_grid(2, 2, 2);
    add_constant(grid, "PORO", 0.2);
    EXPECT_EQ(codes_of(grid), Codes{});
    std::get<std::vector<double>>(grid.info.attributes[0].values).push_back(0.2);
    EXPECT_EQ(codes_of(grid), Codes{"C01 error"});
}

TEST(Checks, C02NamesCellsWithCoordinatesThatAreNotFiniteOrHuge) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e20}) {
        CornerPointGrid grid = brick_grid(3, 1, 2);
        corner(grid, 2, 0, 1, 7) = bad;
        const auto found = findings_of(grid);
        const Finding f = find(found, "C02", Severity::error);
        EXPECT_EQ(cells_of(f), (std::vector<Cell>{{3, 1, 2}}));
        EXPECT_EQ(f.index, std::vector<std::int64_t>{5});
    }
}

TEST(Checks, C02LooksAtPillarsOfActiveCellsOnly) {
    CornerPointGrid grid = brick_grid(2, 1, 1);
    pillar(grid, 2, 0)[0] = 1e30;
    EXPECT_EQ(cells_of(find(findings_of(grid), "C02", Severity::error)), (std::vector<Cell>{{2, 1, 1}}));
    grid.activity = {1, 0};
    EXPECT_EQ(codes_of(grid), Codes{});
    CheckOptions all;
    all.all_cells = true;
    EXPECT_EQ(codes_of(findings_of(grid, all)), Codes{"C02 error"});
}

TEST(Checks, C02TellsOnceOfDepthsThatStandForNoValue) {
    for (const double bad : {-99999.0, -999.25, 9999.0, 1e10, 1e30}) {
        CornerPointGrid grid = brick_grid(6, 4, 2);
        const CornerPointGrid sound = grid;
        for (const std::uint32_t i : {1u, 4u}) corner(grid, i, 2, 0, 3) = bad;
        const auto found = findings_of(grid);
        const Finding f = find(found, "C02", Severity::error);
        EXPECT_EQ(cells_of(f), (std::vector<Cell>{{2, 3, 1}, {5, 3, 1}})) << bad;
        EXPECT_NE(f.message.find("a depth of " + short_number(bad) + " at 2 corners"), std::string::npos) << f.message;
        EXPECT_NE(f.message.find("the first is (2,3,1)"), std::string::npos) << f.message;
        EXPECT_EQ(codes_of(found), Codes{"C02 error"}) << "what follows from it is not told again";
        ASSERT_EQ(f.points.size(), 2u);
        EXPECT_NEAR(f.points[0][0], 1000.0 / 7, 1e-9) << "the middle of the seven other corners";
        EXPECT_LT(f.points[0][2], -1000);
        auto checked = validators::check(grid, {}), plain = validators::check(sound, {});
        ASSERT_TRUE(checked && plain);
        EXPECT_NEAR(checked->lengths.tolerance, plain->lengths.tolerance, 1e-2 * plain->lengths.tolerance)
            << "lengths are those of the rest";
    }
}

TEST(Checks, C02TellsOfPillarsThatStandAtNoValue) {
    CornerPointGrid grid = brick_grid(3, 2, 1);
    for (const std::size_t k : {0u, 1u, 3u, 4u}) pillar(grid, 1, 1)[k] = -99999;
    const Finding f = find(findings_of(grid), "C02", Severity::error);
    EXPECT_EQ(f.count, 4u);
    EXPECT_NE(f.message.find("-99999 in 16 coordinates of pillars"), std::string::npos) << f.message;
}

TEST(Checks, C02LeavesDepthsAloneThatTheGridMayHave) {
    CornerPointGrid deep = brick_grid(4, 4, 2);
    reshape(deep, [](std::uint32_t, std::uint32_t, std::uint32_t, unsigned, double depth) { return depth - 1020 + 9999; });
    EXPECT_EQ(codes_of(deep), Codes{}) << "its base lies at 9999 throughout";
    CornerPointGrid thrown = brick_grid(40, 1, 1);
    reshape(thrown,
            [](std::uint32_t i, std::uint32_t, std::uint32_t, unsigned, double depth) { return i < 20 ? depth - 500 : depth - 11; });
    EXPECT_FALSE(codes_of(thrown).contains("C02 error")) << "the base of one side of a fault lies at 999";
    CornerPointGrid wide = brick_grid(4, 1, 1);
    for (std::uint32_t i = 0; i <= 4; ++i) {
        for (std::uint32_t j = 0; j <= 1; ++j) pillar(wide, i, j)[2] = -99999, pillar(wide, i, j)[5] = 99999;
    }
    EXPECT_EQ(codes_of(wide), Codes{}) << "pillars may be stated by any of their points";
}

TEST(Checks, C03TellsTwistedFromInvertedCells) {
    CornerPointGrid grid = brick_grid(3, 1, 3);
    for (unsigned c = 0; c < 4; ++c) std::swap(corner(grid, 0, 0, 1, c), corner(grid, 0, 0, 1, c + 4));
    std::swap(corner(grid, 2, 0, 1, 1), corner(grid, 2, 0, 1, 5));
    const Finding f = find(findings_of(grid), "C03", Severity::error);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{1, 1, 2}, {3, 1, 2}}));
    EXPECT_EQ(f.count, 2u);
    EXPECT_EQ(measure(f, "inverted"), 1);
    EXPECT_EQ(measure(f, "twisted"), 1);
    EXPECT_DOUBLE_EQ(measure(f, "largest_inversion"), 10);
    EXPECT_FALSE(codes_of(grid).contains("C04 error")) << "what follows from the inversion is not told again";
    EXPECT_TRUE(codes_of(grid).contains("C07 error"));
}

TEST(Checks, C04TellsOverlapsFromGaps) {
    CornerPointGrid grid = brick_grid(2, 1, 3);
    for (unsigned c = 4; c < 8; ++c) corner(grid, 0, 0, 0, c) += 4;
    for (unsigned c = 4; c < 8; ++c) corner(grid, 1, 0, 1, c) -= 3;
    const auto found = findings_of(grid);
    const Finding overlap = find(found, "C04", Severity::error), gap = find(found, "C04", Severity::warning);
    EXPECT_EQ(cells_of(overlap), (std::vector<Cell>{{1, 1, 1}}));
    EXPECT_DOUBLE_EQ(measure(overlap, "overlap"), 4);
    EXPECT_EQ(cells_of(gap), (std::vector<Cell>{{2, 1, 2}}));
    EXPECT_DOUBLE_EQ(measure(gap, "gap"), 3);
}

TEST(Checks, C04LeavesDifferencesWithinTheTolerance) {
    CornerPointGrid grid = brick_grid(1, 1, 2);
    CheckOptions options;
    options.tolerance = 0.5;
    for (const double by : {-0.4, 0.4}) {
        for (unsigned c = 4; c < 8; ++c) corner(grid, 0, 0, 0, c) = 1010 + by;
        EXPECT_EQ(codes_of(findings_of(grid, options)), Codes{});
    }
    for (unsigned c = 4; c < 8; ++c) corner(grid, 0, 0, 0, c) = 1010.6;
    EXPECT_TRUE(codes_of(findings_of(grid, options)).contains("C04 error"));
}

TEST(Checks, C04FindsNoGapWhereInactiveCellsLieBetweenButAnOverlapAcrossThem) {
    CornerPointGrid grid = brick_grid(1, 1, 3);
    grid.activity = {1, 0, 1};
    EXPECT_FALSE(codes_of(grid).contains("C04 warning"));
    for (unsigned c = 4; c < 8; ++c) corner(grid, 0, 0, 0, c) = 1021;
    EXPECT_TRUE(codes_of(grid).contains("C04 error"));
    grid.activity = {1, 0, 0};
    EXPECT_FALSE(codes_of(grid).contains("C04 error"));
}

TEST(Checks, C05AndC06TellCollapsedCellsFromWedges) {
    CornerPointGrid grid = brick_grid(2, 1, 2);
    for (unsigned c = 0; c < 4; ++c) corner(grid, 0, 0, 0, c) = 1010;
    corner(grid, 1, 0, 0, 1) = 1010;
    corner(grid, 1, 0, 0, 3) = 1010;
    const auto found = findings_of(grid);
    EXPECT_EQ(cells_of(find(found, "C05", Severity::warning)), (std::vector<Cell>{{1, 1, 1}}));
    const Finding wedge = find(found, "C06", Severity::info);
    EXPECT_EQ(cells_of(wedge), (std::vector<Cell>{{2, 1, 1}}));
    EXPECT_EQ(measure(wedge, "on_two_pillars"), 1);
    EXPECT_FALSE(codes_of(found).contains("C07 error")) << "det J is 0 on every wedge: that is C06 only";
}

TEST(Checks, C06FindsPyramidsAndTetrahedraWithoutCallingThemInsideOut) {
    for (unsigned collapsed = 1; collapsed <= 3; ++collapsed) {
        CornerPointGrid grid = brick_grid(1, 1, 1);
        for (unsigned c = 0; c < collapsed; ++c) corner(grid, 0, 0, 0, c) = 1010;
        EXPECT_EQ(codes_of(grid), Codes{"C06 info"}) << collapsed;
    }
}

TEST(Checks, C07AndC08FindAConcaveCell) {
    CornerPointGrid grid = brick_grid(1, 1, 1);
    move_pillar(grid, 1, 1, -60, -60);  // behind the diagonal of the others
    const auto found = findings_of(grid);
    EXPECT_EQ(cells_of(find(found, "C07", Severity::error)), (std::vector<Cell>{{1, 1, 1}}));
    const Finding concave = find(found, "C08", Severity::warning);
    EXPECT_EQ(cells_of(concave), (std::vector<Cell>{{1, 1, 1}}));
    EXPECT_NEAR(measure(concave, "depth_of_corner"), (100 - 80) / std::sqrt(2.0), 1e-9);
    move_pillar(grid, 1, 1, 20, 20);  // now before it
    EXPECT_EQ(codes_of(grid), Codes{});
}

TEST(Checks, C07AcceptsAGridThatIsLeftHandedThroughout) {
    CornerPointGrid grid = brick_grid(3, 3, 2);
    for (std::size_t y = 1; y < grid.pillars.size(); y += 3) grid.pillars[y] = -grid.pillars[y];
    EXPECT_EQ(codes_of(grid), Codes{"C12 info"});
}

TEST(Checks, C09TellsSharpAngles) {
    CornerPointGrid grid = brick_grid(2, 1, 1);
    const double degree = std::acos(-1.0) / 180;
    const auto lean = [&](double angle) {
        CornerPointGrid leaning = grid;
        for (std::uint32_t i = 0; i < 3; ++i) move_pillar(leaning, i, 1, 100 / std::tan(angle * degree), 0);
        return leaning;
    };
    EXPECT_EQ(codes_of(lean(11)), Codes{});
    const Finding f = find(findings_of(lean(9)), "C09", Severity::info);
    EXPECT_EQ(f.count, 2u);
    EXPECT_NEAR(measure(f, "beyond_by"), 1, 1e-9);
}

TEST(Checks, C10NamesPillarsOfOneDepth) {
    CornerPointGrid grid = brick_grid(2, 2, 1);
    pillar(grid, 1, 2)[5] = pillar(grid, 1, 2)[2];
    EXPECT_EQ(codes_of(grid), Codes{}) << "both points are the same: the pillar is upright";
    pillar(grid, 1, 2)[3] += 5;
    const Finding f = find(findings_of(grid), "C10", Severity::warning);
    EXPECT_EQ(f.element_kind, "pillar-ij");
    EXPECT_EQ(f.elements, (std::vector<std::int64_t>{2, 3}));
    EXPECT_EQ(f.index, std::vector<std::int64_t>{7});
}

TEST(Checks, C11FindsPillarsThatCrossWithinActiveCells) {
    CornerPointGrid grid = brick_grid(3, 1, 4);
    for (const std::uint32_t j : {0u, 1u}) {
        pillar(grid, 1, j)[3] += 120;  // passes the next one at depth 1033.3, in layer 4
        pillar(grid, 2, j)[3] += 0;
    }
    const Finding f = find(findings_of(grid), "C11", Severity::error);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{2, 1, 4}}));
    grid.activity.assign(12, 1);
    for (const std::size_t cell : {9u, 10u, 11u}) grid.activity[cell] = 0;
    EXPECT_FALSE(codes_of(grid).contains("C11 error")) << "they cross below what is active";
}

TEST(Checks, C11AcceptsPillarsThatMeetAtTheEnd) {
    CornerPointGrid grid = brick_grid(2, 1, 2);
    for (const std::uint32_t j : {0u, 1u}) pillar(grid, 1, j)[3] = pillar(grid, 2, j)[3];
    EXPECT_FALSE(codes_of(grid).contains("C11 error"));
}

TEST(Checks, C12NamesTheFewerOnesOfMixedHands) {
    CornerPointGrid grid = brick_grid(4, 1, 1);
    for (const std::uint32_t j : {0u, 1u}) pillar(grid, 4, j)[0] = pillar(grid, 4, j)[3] = 250;  // the last column folds back
    const Finding f = find(findings_of(grid), "C12", Severity::error);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{4, 1, 1}}));
    EXPECT_EQ(measure(f, "right_handed"), 3);
}

TEST(Checks, C12TellsWhenOnlyTheMapIsMirrored) {
    CornerPointGrid grid = brick_grid(2, 2, 1);
    grid.map_unit = "METRES";
    grid.map_axes = {0, 1, 0, 0, 1, 0};
    EXPECT_EQ(codes_of(grid), Codes{});
    grid.map_axes = {0, -1, 0, 0, 1, 0};
    EXPECT_EQ(codes_of(grid), Codes{"C12 info"});
    grid.map_relative = true;
    EXPECT_EQ(codes_of(grid), Codes{});
}

TEST(Checks, C13KnowsTheUnitsOfTheAxes) {
    CornerPointGrid grid = brick_grid(2, 1, 1);
    grid.info.crs.axis_units.fill("METRES");
    EXPECT_EQ(codes_of(grid), Codes{});
    grid.info.crs.axis_units.fill("FURLONGS");
    EXPECT_EQ(codes_of(grid), Codes{"C13 warning"});
}

TEST(Checks, C13WantsMapAxesThatSpanAPlaneAndTheirUnit) {
    CornerPointGrid grid = brick_grid(1, 1, 1);
    grid.map_axes = {0, 10, 0, 0, 10, 0};
    EXPECT_EQ(codes_of(grid), Codes{"C13 warning"}) << "no MAPUNITS";
    grid.map_unit = "METRES";
    EXPECT_EQ(codes_of(grid), Codes{});
    grid.map_axes = {0, 10, 0, 0, 0, 20};
    EXPECT_EQ(codes_of(grid), Codes{"C13 warning"}) << "both axes run the same way";
    grid.map_axes = {0, 0, 0, 0, 10, 0};
    EXPECT_EQ(codes_of(grid), Codes{"C13 warning"}) << "an axis without length";
}

TEST(Checks, C15AllowsTwoAndThreeOnlyWithTwoPorosities) {
    CornerPointGrid grid = brick_grid(3, 1, 1);
    grid.activity = {1, 2, 3};
    EXPECT_EQ(cells_of(find(findings_of(grid), "C15", Severity::warning)), (std::vector<Cell>{{2, 1, 1}, {3, 1, 1}}));
    grid.porosity = CornerPointGrid::Porosity::dual_porosity;
    EXPECT_EQ(codes_of(grid), Codes{});
}

TEST(Checks, C16ComparesPoreVolumesWithMinpv) {
    CornerPointGrid grid = brick_grid(3, 1, 1);  // 100000 each
    add_constant(grid, "PORO", 0.1);
    add_constant(grid, "NTG", 0.5);
    grid.least_pore_volume = 5000;
    std::get<std::vector<double>>(grid.info.attributes[0].values)[1] = 0.0999;
    EXPECT_EQ(cells_of(find(findings_of(grid), "C16", Severity::info)), (std::vector<Cell>{{2, 1, 1}})) << "5000 is not below 5000";
    grid.activity = {1, 0, 1};
    EXPECT_FALSE(codes_of(grid).contains("C16 info"));
}

TEST(Checks, C16TakesFieldUnitsAsBarrels) {
    CornerPointGrid grid = brick_grid(1, 1, 1);  // 100000 cubic feet, 17810.8 barrels
    add_constant(grid, "PORO", 1);
    grid.unit_system = "FIELD";
    grid.info.crs.axis_units = {"FEET", "FEET", "FEET"};
    grid.least_pore_volume = 17810;
    EXPECT_EQ(codes_of(grid), Codes{});
    grid.least_pore_volume = 17811;
    EXPECT_EQ(codes_of(grid), Codes{"C16 info"});
}

TEST(Checks, C17CountsPartsAndC21NamesLonelyCells) {
    CornerPointGrid grid = brick_grid(4, 1, 2);
    grid.activity = {1, 1, 0, 1, 1, 1, 0, 0};
    const auto found = findings_of(grid);
    const Finding parts = find(found, "C17", Severity::info);
    EXPECT_EQ(measure(parts, "parts"), 2);
    EXPECT_EQ(measure(parts, "largest_part"), 4);
    EXPECT_EQ(cells_of(parts), (std::vector<Cell>{{4, 1, 1}}));
    EXPECT_EQ(cells_of(find(found, "C21", Severity::info)), (std::vector<Cell>{{4, 1, 1}}));
    grid.connections.push_back({1, 3, {}});  // a stated connection joins them
    EXPECT_EQ(codes_of(grid), Codes{});
}

TEST(Checks, C17SeesCellsAcrossFaultsAndPastPinchedOnes) {
    CornerPointGrid grid = brick_grid(2, 1, 3);
    add_throw(grid, 1, 15);
    EXPECT_EQ(codes_of(grid), Codes{"C18 info"});
    add_throw(grid, 1, 15);  // 30: nothing touches any more
    const auto found = findings_of(grid);
    EXPECT_EQ(measure(find(found, "C17", Severity::info), "parts"), 2);
    const Finding columns = find(found, "C21", Severity::info);
    EXPECT_EQ(columns.element_kind, "column-ij");
    EXPECT_EQ(columns.elements, (std::vector<std::int64_t>{1, 1, 2, 1}));
}

TEST(Checks, C18ComparesStatedFaultsWithThrows) {
    CornerPointGrid grid = brick_grid(4, 1, 2);
    add_throw(grid, 2, 5);
    const Finding unstated = find(findings_of(grid), "C18", Severity::info);
    EXPECT_EQ(cells_of(unstated), (std::vector<Cell>{{2, 1, 1}, {2, 1, 2}}));
    EXPECT_DOUBLE_EQ(measure(unstated, "largest_throw"), 5);
    // The same face as + side of column 2 in layer 1 and as - side of column 3 in layer 2.
    grid.faults = {{"A", {{{1, 0, 0}, {1, 0, 0}, CellFace::i_plus}, {{2, 0, 1}, {2, 0, 1}, CellFace::i_minus}}, {}}};
    EXPECT_EQ(codes_of(grid), Codes{});
    // A further record of the same fault where nothing is displaced.
    grid.faults[0].boxes.push_back({{0, 0, 0}, {0, 0, 1}, CellFace::i_plus});
    const Finding idle = find(findings_of(grid), "C18", Severity::info);
    EXPECT_EQ(cells_of(idle), (std::vector<Cell>{{1, 1, 1}, {1, 1, 2}}));
    ASSERT_EQ(idle.entities.size(), 2u);
    EXPECT_EQ(idle.entities[1].name, "A");
}

TEST(Checks, G03NamesStatedFaultsThatDisplaceNothing) {
    CornerPointGrid grid = brick_grid(4, 1, 2);
    add_throw(grid, 2, 5);
    grid.faults = {{"A", {{{1, 0, 0}, {1, 0, 1}, CellFace::i_plus}}, {}}, {"B", {{{1, 0, 0}, {1, 0, 1}, CellFace::i_minus}}, {}}};
    const auto found = findings_of(grid);
    EXPECT_EQ(codes_of(found), Codes{"G03 info"}) << "C18 does not tell it again";
    const Finding f = find(found, "G03", Severity::info);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{1, 1, 1}, {1, 1, 2}}));
    ASSERT_EQ(f.entities.size(), 2u);
    EXPECT_EQ(f.entities[1].name, "B");
    add_throw(grid, 1, 1);
    EXPECT_EQ(codes_of(grid), Codes{});
}

TEST(Checks, C19WarnsWhereSinglePrecisionMovesCorners) {
    CornerPointGrid grid = brick_grid(2, 2, 1);
    EXPECT_EQ(codes_of(grid), Codes{});
    for (std::size_t y = 1; y < grid.pillars.size(); y += 3) grid.pillars[y] += 6000000.2;
    const Finding f = find(findings_of(grid), "C19", Severity::warning);
    EXPECT_EQ(f.count, 4u);
    EXPECT_NEAR(measure(f, "shift"), 0.2, 0.05);
    CheckOptions coarse;
    coarse.tolerance = 0.3;
    EXPECT_EQ(codes_of(findings_of(grid, coarse)), Codes{});
}

TEST(Checks, C20NamesFaultRecordsOutsideTheGridOrNotOnOneFace) {
    CornerPointGrid grid = brick_grid(3, 3, 2);
    grid.faults = {{"GOOD", {{{0, 0, 0}, {0, 2, 1}, CellFace::i_plus}, {{0, 1, 0}, {2, 1, 1}, CellFace::j_minus}}, {}}};
    EXPECT_FALSE(codes_of(grid).contains("C20 error"));
    grid.faults.push_back({"FAR", {{{3, 0, 0}, {3, 2, 1}, CellFace::i_plus}}, {}});
    grid.faults.push_back({"BACK", {{{0, 2, 0}, {0, 1, 1}, CellFace::i_plus}}, {}});
    grid.faults.push_back({"THICK", {{{0, 0, 0}, {1, 2, 1}, CellFace::i_plus}}, {}});
    const Finding f = find(findings_of(grid), "C20", Severity::error);
    EXPECT_EQ(f.count, 3u);
    EXPECT_EQ(measure(f, "outside"), 2);
    EXPECT_EQ(measure(f, "not_on_one_face"), 1);
    ASSERT_EQ(f.entities.size(), 4u);
    EXPECT_EQ(f.entities[3].name, "THICK");
    EXPECT_EQ(cells_of(f)[0], (Cell{4, 1, 1}));
}

TEST(Checks, C22TellsFlatCells) {
    CornerPointGrid grid = brick_grid(2, 1, 2);
    for (unsigned c = 0; c < 4; ++c) corner(grid, 0, 0, 0, c) = 1010 - 0.09;
    const Finding f = find(findings_of(grid), "C22", Severity::info);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{1, 1, 1}}));
    EXPECT_NEAR(measure(f, "aspect"), 100 / 0.09, 1e-6);
    for (unsigned c = 0; c < 4; ++c) corner(grid, 0, 0, 0, c) = 1010 - 0.11;
    EXPECT_FALSE(codes_of(grid).contains("C22 info"));
}

TEST(Checks, ListAtMostAHundredCellsButCountAll) {
    CornerPointGrid grid = brick_grid(20, 20, 1);
    for (double& z : grid.depths) z = 1000;
    const Finding f = find(findings_of(grid), "C05", Severity::warning);
    EXPECT_EQ(f.count, 400u);
    EXPECT_EQ(cells_of(f).size(), 100u);
    EXPECT_EQ(f.index.size(), 100u);
}

TEST(Checks, RunOnlyWhatIsWanted) {
    CornerPointGrid grid = brick_grid(2, 1, 2);
    for (unsigned c = 0; c < 4; ++c) corner(grid, 0, 0, 0, c) = 1010;
    CheckOptions only;
    only.only = {"C06"};
    EXPECT_EQ(codes_of(findings_of(grid, only)), Codes{});
    CheckOptions without;
    without.skip = {"C05", "C18"};
    EXPECT_FALSE(codes_of(findings_of(grid, without)).contains("C05 warning"));
    CheckOptions wrong;
    wrong.only = {"C99"};
    EXPECT_FALSE(validators::known_codes(wrong));
}

TEST(Checks, OfAGridWithoutGeometryLookAtItsRecords) {
    CornerPointGrid grid;
    grid.dims = {3, 3, 2};
    grid.faults = {{"FAR", {{{3, 0, 0}, {3, 2, 1}, CellFace::i_plus}}, {}}};
    EXPECT_EQ(codes_of(grid), (Codes{"C20 error", "F161 info"}));
}

TEST(Lengths, FollowTheDesign) {
    CornerPointGrid grid = brick_grid(2, 2, 2);
    const double diameter = 2 * std::sqrt(100.0 * 100 + 100 * 100 + 10 * 10);
    const validators::GridScope scope(grid, {});
    EXPECT_DOUBLE_EQ(scope.lengths().diameter, diameter);
    EXPECT_DOUBLE_EQ(scope.lengths().tolerance, 1e-7 * diameter);
    EXPECT_DOUBLE_EQ(scope.lengths().near, 1e-3 * diameter);
    grid.info.precision = CoordinatePrecision::single_precision;
    EXPECT_DOUBLE_EQ(validators::GridScope(grid, {}).lengths().tolerance, 4 * std::ldexp(1.0, -14)) << "four steps of a float at 1020";
    CheckOptions given;
    given.tolerance = 0.25;
    EXPECT_EQ(validators::GridScope(grid, given).lengths().tolerance, 0.25);
    // An inactive cell far away changes nothing.
    grid.activity = {1, 1, 1, 1, 1, 1, 1, 0};
    corner(grid, 1, 1, 1, 7) = 1e6;
    EXPECT_NEAR(validators::GridScope(grid, {}).lengths().diameter, diameter, 0.1 * diameter);
    grid.activity.assign(grid.cell_count(), 0);
    EXPECT_EQ(validators::GridScope(grid, {}).lengths().tolerance, 0) << "no cell, no length";
}

}  // namespace
}  // namespace geomend
