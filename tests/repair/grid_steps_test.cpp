// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/grid_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grid/cell_geometry.h"
#include "grid/connections.h"
#include "validators/checks_testing.h"

namespace geomend {
namespace {

using namespace testing;
using Codes = std::set<std::string>;

// Takes steps on one grid and gives what they say.
std::vector<repair::StepDone> mend(CornerPointGrid& grid, const std::vector<std::string>& steps, std::optional<double> gap = {}) {
    Dataset dataset;
    dataset.objects.emplace_back(std::move(grid));
    auto done = repair::run_grid_steps(dataset, steps, {{}, gap});
    grid = std::move(std::get<CornerPointGrid>(dataset.objects.front()));
    return done ? std::move(*done) : std::vector<repair::StepDone>{};
}

TEST(RepairSteps, LeaveASoundGridAsItIs) {
    const CornerPointGrid before = brick_grid(3, 3, 2);
    for (const repair::StepRow& row : repair::grid_steps()) {
        CornerPointGrid grid = before;
        const auto done = mend(grid, {std::string(row.name)});
        ASSERT_EQ(done.size(), 1u);
        EXPECT_EQ(done[0].report.count, 0u) << row.name;
        EXPECT_FALSE(done[0].report.message.empty());
        EXPECT_EQ(grid.depths, before.depths) << row.name;
        EXPECT_EQ(grid.pillars, before.pillars) << row.name;
        EXPECT_EQ(active_count(grid), before.cell_count()) << row.name;
    }
}

TEST(RepairSteps, MonotoneBringsBottomsDownAndKeepsCellsInTouch) {
    CornerPointGrid grid = brick_grid(1, 1, 3);
    for (unsigned c = 0; c < 4; ++c) {
        corner(grid, 0, 0, 1, c + 4) = 1006;  // above its top at 1010; the cell below touches it
        corner(grid, 0, 0, 2, c) = 1006;
    }
    ASSERT_TRUE(codes_of(grid).contains("C03 error"));
    const auto done = mend(grid, {"monotone"});
    EXPECT_EQ(cells_of(done[0].report), (std::vector<Cell>{{1, 1, 2}}));
    EXPECT_EQ(measure(done[0].report, "largest_move"), 4);
    EXPECT_EQ(codes_of(grid), Codes{"C05 warning"});
    EXPECT_EQ(corner(grid, 0, 0, 2, 0), 1010);
}

TEST(RepairSteps, MonotoneMendsATwistedCell) {
    CornerPointGrid grid = brick_grid(2, 1, 1);
    corner(grid, 0, 0, 0, 4) = 990;
    mend(grid, {"monotone"});
    EXPECT_EQ(codes_of(grid), (Codes{"C06 info"}));
}

TEST(RepairSteps, CloseGapsMeetsAtTheMeanUpToTheLengthGiven) {
    CornerPointGrid grid = brick_grid(2, 1, 2);
    for (unsigned c = 4; c < 8; ++c) {
        corner(grid, 0, 0, 0, c) = 1012;  // overlaps by 2
        corner(grid, 1, 0, 0, c) = 1007;  // a gap of 3
    }
    CornerPointGrid untouched = grid;
    EXPECT_EQ(mend(untouched, {"close-gaps"})[0].report.count, 0u) << "both are more than the tolerance";
    EXPECT_EQ(untouched.depths, grid.depths);
    const auto done = mend(grid, {"close-gaps"}, 2.5);
    EXPECT_EQ(cells_of(done[0].report), (std::vector<Cell>{{1, 1, 1}}));
    EXPECT_EQ(corner(grid, 0, 0, 0, 4), 1011);
    EXPECT_EQ(corner(grid, 0, 0, 1, 0), 1011);
    EXPECT_EQ(corner(grid, 1, 0, 0, 4), 1007) << "3 is more than 2.5";
    mend(grid, {"close-gaps"}, 3.0);
    EXPECT_FALSE(codes_of(grid).contains("C04 error"));
    EXPECT_FALSE(codes_of(grid).contains("C04 warning"));
}

TEST(RepairSteps, CloseGapsLeavesWhatInactiveCellsFill) {
    CornerPointGrid grid = brick_grid(1, 1, 3);
    grid.activity = {1, 0, 1};
    const auto before = grid.depths;
    EXPECT_EQ(mend(grid, {"close-gaps"}, 50.0)[0].report.count, 0u);
    EXPECT_EQ(grid.depths, before);
}

TEST(RepairSteps, DropCollapsedIsolatedAndMinpvMakeCellsInactive) {
    CornerPointGrid grid = brick_grid(3, 1, 2);
    for (unsigned c = 0; c < 4; ++c) corner(grid, 1, 0, 0, c) = 1010;
    grid.connections = {{1, 5, 2.0}, {0, 2, {}}};
    auto done = mend(grid, {"drop-collapsed"});
    EXPECT_EQ(cells_of(done[0].report), (std::vector<Cell>{{2, 1, 1}}));
    EXPECT_EQ(measure(done[0].report, "connections_to_them"), 1);
    EXPECT_EQ(grid.connections.size(), 2u);
    EXPECT_EQ(grid.activity, (std::vector<std::uint8_t>{1, 0, 1, 1, 1, 1}));

    grid = brick_grid(3, 1, 1);
    grid.activity = {1, 1, 0};
    add_constant(grid, "PORO", 0.2);
    std::get<std::vector<double>>(grid.info.attributes[0].values)[0] = 0;
    done = mend(grid, {"minpv", "drop-isolated"});
    EXPECT_EQ(cells_of(done[0].report), (std::vector<Cell>{{1, 1, 1}}));
    EXPECT_EQ(done[1].report.count, 0u) << "the only cell that is left is not isolated";
    grid.activity = {1, 0, 1};
    done = mend(grid, {"drop-isolated"});
    EXPECT_EQ(done[0].report.count, 2u);
}

TEST(RepairSteps, PinchClosesThinInactiveLayers) {
    CornerPointGrid grid = brick_grid(2, 1, 3);
    grid.activity = {1, 1, 0, 0, 1, 1};
    for (unsigned c = 4; c < 8; ++c) corner(grid, 0, 0, 0, c) = corner(grid, 0, 0, 1, c - 4) = 1019.5;
    grid.pinch = CornerPointGrid::Pinch{};
    grid.pinch->threshold = 0.6;
    ASSERT_EQ(grid::connections(grid).neighbours[0] & grid::Connections::below, 0);
    const auto done = mend(grid, {"pinch"});
    EXPECT_EQ(cells_of(done[0].report), (std::vector<Cell>{{1, 1, 1}}));
    EXPECT_EQ(corner(grid, 0, 0, 2, 0), 1019.75);
    EXPECT_NE(grid::connections(grid).neighbours[0] & grid::Connections::below, 0);
}

TEST(RepairSteps, DepthSignTurnsElevations) {
    CornerPointGrid grid = brick_grid(2, 2, 2);
    const auto before = grid.depths;
    for (double& z : grid.depths) z = -z;
    for (std::size_t z = 2; z < grid.pillars.size(); z += 3) grid.pillars[z] = -grid.pillars[z];
    ASSERT_TRUE(codes_of(grid).contains("C03 error"));
    mend(grid, {"depth-sign"});
    EXPECT_EQ(grid.depths, before);
    EXPECT_EQ(codes_of(grid), Codes{});
}

// A left-handed grid with a mark in everything that names cells.
CornerPointGrid left_handed_grid() {
    CornerPointGrid grid = brick_grid(3, 4, 2);
    add_throw(grid, 2, 3);
    for (std::size_t y = 1; y < grid.pillars.size(); y += 3) grid.pillars[y] = -grid.pillars[y];
    pillar(grid, 0, 1)[3] += 7;
    corner(grid, 1, 0, 1, 6) += 2;
    grid.activity.assign(24, 1);
    grid.activity[grid.cell(2, 3, 1)] = 0;
    for (const char* name : {"PORO", "TRANY", "MULTY"}) {
        add_constant(grid, name, 0);
        auto& values = std::get<std::vector<double>>(grid.info.attributes.back().values);
        for (std::size_t c = 0; c < values.size(); ++c) values[c] = static_cast<double>(c + 1);
    }
    grid.faults = {{"F", {{{1, 0, 0}, {1, 2, 1}, CellFace::i_plus}, {{0, 1, 0}, {2, 1, 0}, CellFace::j_plus}}, {}}};
    grid.connections = {{grid.cell(0, 0, 0), grid.cell(2, 3, 0), 1.5}};
    return grid;
}

TEST(RepairSteps, HandednessReversesRowsAndCarriesAllAlong) {
    const CornerPointGrid before = left_handed_grid();
    CornerPointGrid grid = before;
    const auto done = mend(grid, {"handedness"});
    EXPECT_EQ(done[0].report.count, 24u);
    EXPECT_FALSE(codes_of(grid).contains("C12 info"));
    const auto& poro = std::get<std::vector<double>>(grid.info.attributes[0].values);
    const auto& trany = std::get<std::vector<double>>(grid.info.attributes[1].values);
    EXPECT_EQ(grid.info.attributes[2].name, "MULTY-");
    for (std::uint32_t k = 0; k < 2; ++k) {
        for (std::uint32_t j = 0; j < 4; ++j) {
            for (std::uint32_t i = 0; i < 3; ++i) {
                const auto old_corners = cell_corners(before, i, j, k), new_corners = cell_corners(grid, i, 3 - j, k);
                for (unsigned c = 0; c < 8; ++c) EXPECT_EQ(new_corners[c ^ 2u], old_corners[c]);
                EXPECT_EQ(grid::cell_volume(new_corners), -grid::cell_volume(old_corners));
                EXPECT_EQ(grid.is_active(grid.cell(i, 3 - j, k)), before.is_active(before.cell(i, j, k)));
                EXPECT_EQ(poro[grid.cell(i, 3 - j, k)], static_cast<double>(before.cell(i, j, k) + 1));
                if (j < 3) {
                    EXPECT_EQ(trany[grid.cell(i, 2 - j, k)], static_cast<double>(before.cell(i, j, k) + 1));
                }
            }
        }
    }
    EXPECT_EQ(grid.faults[0].boxes[0].first, (std::array<std::uint32_t, 3>{1, 1, 0}));
    EXPECT_EQ(grid.faults[0].boxes[0].last, (std::array<std::uint32_t, 3>{1, 3, 1}));
    EXPECT_EQ(grid.faults[0].boxes[1].first[1], 2u);
    EXPECT_EQ(grid.faults[0].boxes[1].face, CellFace::j_minus);
    EXPECT_EQ(grid.connections[0].first, grid.cell(0, 3, 0));
    EXPECT_EQ(grid.connections[0].second, grid.cell(2, 0, 0));
    EXPECT_EQ(mend(grid, {"handedness"})[0].report.count, 0u) << "a second time there is nothing to do";
}

TEST(RepairSteps, LocalGridsFollowTheReversalOfTheirHost) {
    Dataset dataset;
    dataset.objects.emplace_back(left_handed_grid());
    CornerPointGrid local = brick_grid(2, 2, 1);
    local.info.name = "LGR";
    local.host = CornerPointGrid::Host{};
    local.host->first = {0, 0, 0};
    local.host->last = {0, 1, 0};
    local.host->cells = {0, 0, 3, 3};
    dataset.objects.emplace_back(std::move(local));
    const std::vector<std::string> steps{"handedness"};
    ASSERT_TRUE(repair::run_grid_steps(dataset, steps, {}));
    const auto& follower = std::get<CornerPointGrid>(dataset.objects[1]);
    EXPECT_EQ(follower.host->first[1], 2u);
    EXPECT_EQ(follower.host->last[1], 3u);
    EXPECT_EQ(follower.host->cells, (std::vector<std::uint64_t>{9, 9, 6, 6}));
}

TEST(RepairSteps, UnknownNamesAreRefusedWithTheKnownOnes) {
    const std::vector<std::string> steps{"smooth"};
    const auto known = repair::known_grid_steps(steps);
    ASSERT_FALSE(known);
    EXPECT_NE(known.why().error.message.find("close-gaps"), std::string::npos);
}

}  // namespace
}  // namespace geomend
