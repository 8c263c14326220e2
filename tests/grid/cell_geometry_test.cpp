// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/cell_geometry.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

TEST(CellGeometry, a_brick_has_its_volume_and_middle) {
    const CornerPointGrid grid = testing::brick_grid(2, 3, 4);
    EXPECT_DOUBLE_EQ(cell_volume(grid, 1, 2, 3), 1e5);
    EXPECT_DOUBLE_EQ(volume(grid), 24e5);
    const Corners corners = cell_corners(grid, 1, 2, 3);
    EXPECT_EQ(centre(corners), (Vec3{150, 250, 1035}));
    EXPECT_DOUBLE_EQ(thickness(corners), 10);
    for (const double j : corner_jacobians(corners)) EXPECT_DOUBLE_EQ(j, 1e5);
}

TEST(CellGeometry, a_mirrored_grid_has_negative_cells_and_the_same_volume) {
    CornerPointGrid grid = testing::brick_grid(2, 2, 2);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 3) grid.pillars[p] = -grid.pillars[p];
    EXPECT_DOUBLE_EQ(cell_volume(grid, 0, 0, 0), -1e5);
    EXPECT_DOUBLE_EQ(volume(grid), 8e5);
}

TEST(CellGeometry, the_volume_of_a_twisted_cell_is_that_of_its_trilinear_map) {
    // One bottom corner drawn up by 10: thickness 10 (1 - u v) over 100 x 100, so a quarter of a brick is lost.
    CornerPointGrid grid = testing::brick_grid(1, 1, 1);
    grid.depths[corner_index(grid.dims, 0, 0, 0, 7)] = 1000;
    EXPECT_NEAR(cell_volume(grid, 0, 0, 0), 75000, 1e-9);
    // Centre of volume along x: integral of u (1 - u v) over that of (1 - u v) = (1/2 - 1/6) / (3/4).
    EXPECT_NEAR(centroid(cell_corners(grid, 0, 0, 0))[0], 100 * (1.0 / 2 - 1.0 / 6) / 0.75, 1e-9);
}

TEST(CellGeometry, inactive_cells_do_not_count) {
    CornerPointGrid grid = testing::brick_grid(2, 2, 1);
    grid.activity = {1, 0, 1, 1};
    EXPECT_DOUBLE_EQ(volume(grid), 3e5);
    EXPECT_EQ(cell_volumes(grid).size(), 4u);
}

TEST(CellGeometry, far_from_the_origin_the_digits_stay) {
    CornerPointGrid grid = testing::brick_grid(1, 1, 1);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 3) {
        grid.pillars[p] += 456789;
        grid.pillars[p + 1] += 5936000;
    }
    EXPECT_NEAR(volume(grid), 1e5, 1e-5);
}

TEST(CellGeometry, a_ring_of_cylindrical_cells_has_the_volume_of_a_pipe) {
    CornerPointGrid grid = testing::brick_grid(1, 4, 1);
    grid.cylindrical = true;
    for (std::uint32_t j = 0; j <= 4; ++j) {
        for (std::uint32_t i = 0; i <= 1; ++i) {
            double* pillar = grid.pillars.data() + 6 * (i + 2 * j);
            pillar[0] = pillar[3] = 1.0 + i;
            pillar[1] = pillar[4] = 90.0 * j;
        }
    }
    EXPECT_NEAR(volume(grid), std::numbers::pi * (4 - 1) * 10, 1e-9);
}

TEST(CornerPoint, a_pillar_without_height_is_upright) {
    const double flat[6] = {1, 2, 5, 9, 9, 5};
    EXPECT_EQ(pillar_point(flat, 7), (Vec3{1, 2, 7}));
    const double slanted[6] = {0, 0, 0, 10, 20, 10};
    EXPECT_EQ(pillar_point(slanted, 5), (Vec3{5, 10, 5}));
}

TEST(CornerPoint, arrays_that_do_not_fit_the_dimensions_are_named) {
    CornerPointGrid grid = testing::brick_grid(2, 2, 2);
    EXPECT_EQ(misfit(grid), "");
    grid.depths.pop_back();
    EXPECT_EQ(misfit(grid), "corner depths: expected 64 values, found 63");
}

}  // namespace
}  // namespace geomend::grid
