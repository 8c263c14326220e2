// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/local_origin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grid/map_axes.h"
#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

// Coordinates in a zone of UTM, with decimals that single precision cannot keep there.
CornerPointGrid on_the_map() {
    CornerPointGrid grid = testing::brick_grid(40, 30, 2);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 3) {
        grid.pillars[p] += 461234.567 + 0.013 * double(p);
        grid.pillars[p + 1] += 5932109.876;
    }
    return grid;
}

std::vector<double> through_float(std::vector<double> values) {
    for (double& v : values) v = static_cast<double>(static_cast<float>(v));
    return values;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

// Stores the moved grid as a file of single precision would, and applies its map axes.
CornerPointGrid stored_and_applied(CornerPointGrid grid) {
    grid.pillars = through_float(grid.pillars);
    for (double& v : *grid.map_axes) v = static_cast<double>(static_cast<float>(v));
    EXPECT_TRUE(apply_map_axes(grid).ok());
    return grid;
}

TEST(LocalOrigin, of_a_grid_in_map_coordinates_is_round_and_exact_in_single_precision) {
    const CornerPointGrid grid = on_the_map();
    CornerPointGrid moved = grid;
    const auto frame = local_frame(grid);
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame->origin, (std::array<double, 2>{463000, 5934000}));
    EXPECT_EQ(frame->map_axes, (std::array<double, 6>{463000, 5935000, 463000, 5934000, 464000, 5934000}));
    const auto rounding = move_into(*frame, moved);
    ASSERT_TRUE(rounding.ok());
    EXPECT_EQ(*rounding, 0);
    EXPECT_LT(std::abs(moved.pillars[0]), 3000);
    const CornerPointGrid back = stored_and_applied(moved);
    // Half a step of floats of up to 4096.
    EXPECT_LE(largest_difference(back.pillars, grid.pillars), 1.23e-4);
    EXPECT_GT(largest_difference(through_float(grid.pillars), grid.pillars), 0.1);
    ASSERT_TRUE(apply_map_axes(moved).ok());
    EXPECT_LE(largest_difference(moved.pillars, grid.pillars), 1e-9);
}

TEST(LocalOrigin, keeps_turned_and_mirrored_axes_to_the_precision_of_the_local_coordinates) {
    for (const double degrees : {0.0, 30.0, 123.4, 200.0, 271.0, 359.9}) {
        for (const double mirror : {1.0, -1.0}) {
            SCOPED_TRACE(degrees);
            CornerPointGrid grid = on_the_map();
            const double a = degrees * std::acos(-1) / 180, c = std::cos(a), s = std::sin(a);
            // The axes start far away, as those of a field that a sector was cut from.
            grid.map_axes =
                std::array<double, 6>{1000 - mirror * s * 100, -2000 + mirror * c * 100, 1000, -2000, 1000 + c * 100, -2000 + s * 100};
            CornerPointGrid expected = grid, moved = grid;
            ASSERT_TRUE(apply_map_axes(expected).ok());
            const auto frame = local_frame(grid);
            ASSERT_TRUE(frame.ok());
            const auto rounding = move_into(*frame, moved);
            ASSERT_TRUE(rounding.ok());
            EXPECT_EQ(*rounding, 0);
            EXPECT_LE(largest_difference(stored_and_applied(moved).pillars, expected.pillars), 5e-4);
            ASSERT_TRUE(apply_map_axes(moved).ok());
            EXPECT_LE(largest_difference(moved.pillars, expected.pillars), 1e-8);
        }
    }
}

TEST(LocalOrigin, counts_in_the_unit_of_the_grid) {
    CornerPointGrid grid = on_the_map();
    for (double& v : grid.pillars) v /= 0.3048;
    grid.info.crs.axis_units = {"FEET", "FEET", "FEET"};
    grid.map_unit = "METRES";
    grid.map_axes = std::array<double, 6>{0, 1, 0, 0, 1, 0};
    CornerPointGrid expected = grid, moved = grid;
    ASSERT_TRUE(apply_map_axes(expected).ok());
    const auto frame = local_frame(grid);
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame->origin, (std::array<double, 2>{463000, 5934000}));
    ASSERT_TRUE(move_into(*frame, moved).ok());
    EXPECT_EQ(moved.depths, grid.depths);
    ASSERT_TRUE(apply_map_axes(moved).ok());
    EXPECT_LE(largest_difference(moved.pillars, expected.pillars), 1e-8);
}

TEST(LocalOrigin, is_refused_where_map_axes_cannot_be_applied) {
    CornerPointGrid grid = on_the_map();
    grid.map_axes = std::array<double, 6>{0, 0, 0, 0, 1, 0};
    EXPECT_FALSE(local_frame(grid).ok());
    grid.map_axes.reset();
    grid.cylindrical = true;
    EXPECT_FALSE(local_frame(grid).ok());
}

}  // namespace
}  // namespace geomend::grid
