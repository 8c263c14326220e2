// SPDX-License-Identifier: AGPL-3.0-or-later
// What region numbers and fault records claim: C23 to C26.
#include <gtest/gtest.h>

#include "validators/checks_testing.h"

namespace geomend {
namespace {

using namespace testing;
using Codes = std::set<std::string>;

void add_numbers(CornerPointGrid& grid, std::string name, std::vector<std::int32_t> numbers) {
    Attribute a;
    a.name = std::move(name);
    a.location = AttributeLocation::cell;
    a.values = std::move(numbers);
    grid.info.attributes.push_back(std::move(a));
}

TEST(RegionNumbers, C23NamesRegionsInSeveralParts) {
    CornerPointGrid grid = brick_grid(6, 1, 1);
    add_numbers(grid, "FIPNUM", {1, 2, 1, 1, 2, 3});
    const Finding f = find(findings_of(grid), "C23", Severity::info);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{1, 1, 1}, {5, 1, 1}})) << "the larger part, or the first, is at home";
    EXPECT_EQ(measure(f, "regions"), 2);
    ASSERT_EQ(f.entities.size(), 3u);
    EXPECT_EQ(f.entities[1].name, "FIPNUM_1");
    EXPECT_EQ(f.entities[2].name, "FIPNUM_2");
    EXPECT_NE(f.message.find("2 of 3 regions of FIPNUM"), std::string::npos) << f.message;
    std::get<std::vector<std::int32_t>>(grid.info.attributes[0].values) = {1, 1, 1, 2, 2, 3};
    EXPECT_EQ(codes_of(grid), Codes{});
}

TEST(RegionNumbers, C23LeavesKindsOfRockAlone) {
    CornerPointGrid grid = brick_grid(4, 1, 1);
    for (const char* name : {"SATNUM", "ROCKNUM", "PORO"}) add_numbers(grid, name, {1, 2, 1, 2});
    EXPECT_EQ(codes_of(grid), Codes{});
    add_numbers(grid, "FIPZON", {1, 2, 1, 2});
    EXPECT_EQ(codes_of(grid), Codes{"C23 info"});
}

TEST(RegionNumbers, C23GoesAcrossFaultsAndStatedConnections) {
    CornerPointGrid grid = brick_grid(2, 1, 3);
    add_throw(grid, 1, 15);  // (2,1,1) touches (1,1,2) and (1,1,3); (2,1,2) touches (1,1,3); (2,1,3) touches none of column 1
    add_numbers(grid, "EQLNUM", {1, 2, 1, 2, 2, 1});
    const Finding f = find(findings_of(grid), "C23", Severity::info);
    EXPECT_EQ(measure(f, "regions"), 1) << "region 2 hangs together across the fault";
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{2, 1, 3}}));
    grid.connections.push_back({2, 5, {}});
    EXPECT_FALSE(codes_of(grid).contains("C23 info"));
}

TEST(RegionNumbers, C23DoesNotTellOfLayersThatFaultsTear) {
    CornerPointGrid grid = brick_grid(4, 1, 2);
    add_throw(grid, 2, 10);  // layer 1 meets layer 2 only
    add_numbers(grid, "FIPNUM", {1, 1, 1, 1, 2, 2, 2, 2});
    EXPECT_EQ(codes_of(grid), Codes{"C18 info"});
}

TEST(RegionNumbers, C23DoesNotTellAgainThatTheGridFallsApart) {
    CornerPointGrid grid = brick_grid(5, 1, 1);
    add_numbers(grid, "FIPNUM", {1, 1, 1, 1, 1});
    grid.activity = {1, 1, 0, 1, 1};
    EXPECT_EQ(codes_of(grid), Codes{"C17 info"});
}

TEST(RegionNumbers, C23PassesOverMissingNumbers) {
    CornerPointGrid grid = brick_grid(5, 1, 1);
    Attribute a;
    a.name = "FIPNUM";
    a.location = AttributeLocation::cell;
    const double none = std::numeric_limits<double>::quiet_NaN();
    a.values = std::vector<double>{none, 1, 1, none, -999};
    a.no_data = -999;
    grid.info.attributes.push_back(a);
    EXPECT_EQ(codes_of(grid), Codes{});
}

TEST(RegionNumbers, C24WantsThemFromOneInActiveCells) {
    CornerPointGrid grid = brick_grid(3, 1, 1);
    grid.activity = {1, 1, 0};
    add_numbers(grid, "EQLNUM", {1, 1, 0});
    add_numbers(grid, "FLUXNUM", {0, 0, 0});  // may be 0
    EXPECT_EQ(codes_of(grid), Codes{});
    add_numbers(grid, "SATNUM", {1, 0, 0});
    const Finding f = find(findings_of(grid), "C24", Severity::warning);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{2, 1, 1}}));
    ASSERT_EQ(f.entities.size(), 2u);
    EXPECT_EQ(f.entities[1].name, "SATNUM");
}

TEST(StatedConnections, C29NamesThoseOfCellsThatTouchAnyway) {
    CornerPointGrid grid = brick_grid(4, 2, 2);
    grid.connections = {{0, 1, 5.0}, {5, 1, 2.0}, {3, 11, 1.0}, {0, 6, 1.0}};
    const Finding f = find(findings_of(grid), "C29", Severity::warning);
    EXPECT_EQ(f.count, 3u) << "side by side along each axis, and not at a corner";
    EXPECT_NE(f.message.find("faces touch"), std::string::npos) << f.message;
    grid = brick_grid(2, 1, 1);
    add_throw(grid, 1, 100);  // no longer side by side
    grid.connections = {{0, 1, 5.0}};
    EXPECT_FALSE(codes_of(grid).contains("C29 warning"));
}

TEST(FaultRecords, C25NamesFaultsBetweenNoActiveCells) {
    CornerPointGrid grid = brick_grid(4, 1, 2);
    grid.faults = {{"EDGE", {{{3, 0, 0}, {3, 0, 1}, CellFace::i_plus}}, {}}};
    const Finding f = find(findings_of(grid), "C25", Severity::info);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{4, 1, 1}, {4, 1, 2}}));
    grid.faults[0].multiplier = 1;
    EXPECT_EQ(codes_of(grid), Codes{"C25 info"});
    grid.faults[0].multiplier = 0.1;
    EXPECT_EQ(codes_of(grid), Codes{"C25 warning"}) << "a multiplier was meant to do something";
    grid.faults.push_back({"TOO", {{{0, 0, 0}, {0, 0, 0}, CellFace::i_minus}}, {}});
    grid.faults.push_back({"THREE", {{{0, 0, 1}, {0, 0, 1}, CellFace::i_minus}}, {}});
    const auto found = findings_of(grid);
    EXPECT_EQ(measure(find(found, "C25", Severity::warning), "faults"), 1);
    EXPECT_EQ(measure(find(found, "C25", Severity::info), "faults"), 2) << "one finding for all";
    grid.faults = {{"MET", {{{1, 0, 0}, {1, 0, 1}, CellFace::i_plus}}, 0.1}};
    add_throw(grid, 2, 5);
    EXPECT_EQ(codes_of(grid), Codes{});
    grid.activity = {1, 1, 0, 0, 1, 1, 0, 0};
    EXPECT_EQ(codes_of(grid), Codes{"C25 warning"});
    // A cell of another layer beyond the throw is enough.
    grid.activity = {1, 0, 1, 1, 1, 1, 0, 0};
    EXPECT_FALSE(codes_of(grid).contains("C25 warning"));
}

TEST(FaultRecords, C25NamesMultipliersWithoutAFault) {
    CornerPointGrid grid = brick_grid(2, 1, 1);
    grid.faults = {{"NOWHERE", {}, 0.5}};
    const Finding f = find(findings_of(grid), "C25", Severity::warning);
    EXPECT_EQ(f.count, 1u);
    ASSERT_EQ(f.entities.size(), 2u);
    EXPECT_EQ(f.entities[1].name, "NOWHERE");
    CornerPointGrid bare;
    bare.dims = {2, 1, 1};
    bare.faults = grid.faults;
    EXPECT_EQ(codes_of(bare), Codes{"F161 info"}) << "its faces may be in another file";
}

TEST(FaultRecords, C26FindsSidesOfTwoFaults) {
    CornerPointGrid grid = brick_grid(4, 1, 2);
    add_throw(grid, 2, 5);
    // The same side twice in one fault is no matter.
    grid.faults = {{"A", {{{1, 0, 0}, {1, 0, 1}, CellFace::i_plus}, {{2, 0, 0}, {2, 0, 0}, CellFace::i_minus}}, {}}};
    EXPECT_EQ(codes_of(grid), Codes{});
    grid.faults.push_back({"B", {{{2, 0, 1}, {2, 0, 1}, CellFace::i_minus}}, {}});
    const Finding f = find(findings_of(grid), "C26", Severity::info);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{2, 1, 2}}));
    EXPECT_EQ(measure(f, "sides"), 1);
    ASSERT_EQ(f.entities.size(), 3u);
}

}  // namespace
}  // namespace geomend
