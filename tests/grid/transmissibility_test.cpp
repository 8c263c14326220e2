// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/transmissibility.h"

#include <gtest/gtest.h>

#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

CornerPointGrid with_rock() {
    CornerPointGrid grid = testing::brick_grid(2, 2, 2);
    testing::add_constant(grid, "PERMX", 200);
    testing::add_constant(grid, "PERMZ", 20);
    return grid;
}

constexpr double metric = 0.00852701702442635;

TEST(Transmissibility, of_bricks_is_permeability_times_area_over_length) {
    const CornerPointGrid grid = with_rock();
    const auto t = transmissibilities(grid, connections(grid));
    ASSERT_TRUE(t.ok());
    EXPECT_NEAR(t->x[0], metric * 200 * 1000 / 100, 1e-9);
    EXPECT_NEAR(t->y[0], metric * 200 * 1000 / 100, 1e-9) << "PERMY is PERMX where it is not given";
    EXPECT_NEAR(t->z[0], metric * 20 * 10000 / 10, 1e-7);
    EXPECT_EQ(t->x[1], 0);
    EXPECT_EQ(t->z[4], 0);
}

TEST(Transmissibility, in_field_units_has_the_usual_constant) {
    EXPECT_NEAR(transmissibility_factor("FIELD"), 0.00112712, 1e-8);
    EXPECT_NEAR(transmissibility_factor("LAB"), 3.6, 0.05);
}

TEST(Transmissibility, of_a_grid_in_feet_within_a_metric_deck_is_converted) {
    CornerPointGrid grid = with_rock();
    grid.unit_system = "METRIC";
    grid.info.crs.axis_units = {"FEET", "FEET", "FEET"};
    const auto t = transmissibilities(grid, connections(grid));
    EXPECT_NEAR(t->x[0], metric * 0.3048 * 2000, 1e-9);
}

TEST(Transmissibility, net_to_gross_acts_on_sides_only) {
    CornerPointGrid grid = with_rock();
    testing::add_constant(grid, "NTG", 0.5);
    const auto t = transmissibilities(grid, connections(grid));
    EXPECT_NEAR(t->x[0], metric * 1000, 1e-9);
    EXPECT_NEAR(t->z[0], metric * 20 * 1000, 1e-7);
}

TEST(Transmissibility, across_a_fault_goes_with_the_shared_area) {
    CornerPointGrid grid = with_rock();
    testing::add_throw(grid, 1, 5);
    const Connections found = connections(grid);
    const auto t = transmissibilities(grid, found);
    // Half the area, but the centres of the faces stay where they are.
    EXPECT_NEAR(t->x[0], metric * 1000, 1e-9);
    ASSERT_EQ(found.others.size(), 2u);
    EXPECT_NEAR(t->others[0], metric * 1000, 1e-9);
}

TEST(Transmissibility, multipliers_of_cells_faults_and_regions_multiply) {
    CornerPointGrid grid = with_rock();
    testing::add_constant(grid, "MULTX", 0.5);
    testing::add_constant(grid, "MULTX-", 0.1);
    grid.faults.push_back({"F", {{{0, 0, 0}, {0, 0, 1}, CellFace::i_plus}}, 0.25});
    Attribute regions;
    regions.name = "MULTNUM";
    regions.location = AttributeLocation::cell;
    regions.values = std::vector<std::int32_t>{1, 1, 2, 2, 1, 1, 2, 2};
    grid.info.attributes.push_back(regions);
    grid.region_multipliers.push_back({1, 2, 0.125, "XYZ", "ALL", 'M'});
    const auto t = transmissibilities(grid, connections(grid));
    EXPECT_NEAR(t->x[0], metric * 2000 * 0.5 * 0.1 * 0.25, 1e-9);
    EXPECT_NEAR(t->x[2], metric * 2000 * 0.5 * 0.1, 1e-9);
    EXPECT_NEAR(t->y[0], metric * 2000 * 0.125, 1e-9);
}

TEST(Transmissibility, flows_past_collapsed_cells_only_with_pinch) {
    CornerPointGrid grid = testing::brick_grid(1, 1, 3);
    testing::add_constant(grid, "PERMX", 100);
    testing::reshape(
        grid, [](auto, auto, std::uint32_t k, unsigned c, double depth) { return k == 2 || (k == 1 && c >= 4) ? depth - 10 : depth; });
    EXPECT_EQ(transmissibilities(grid, connections(grid))->z[0], 0);
    grid.pinch = CornerPointGrid::Pinch{};
    EXPECT_NEAR(transmissibilities(grid, connections(grid))->z[0], metric * 100 * 1000, 1e-6);
}

TEST(Transmissibility, without_permeability_is_a_failure_that_names_it) {
    const CornerPointGrid grid = testing::brick_grid(1, 1, 2);
    const auto t = transmissibilities(grid, connections(grid));
    ASSERT_FALSE(t.ok());
    EXPECT_NE(t.why().error.message.find("PERMX"), std::string::npos);
}

}  // namespace
}  // namespace geomend::grid
