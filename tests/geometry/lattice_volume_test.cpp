// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "geometry/measures.h"

namespace geomend {
namespace {

StructuredGrid box(std::uint32_t ni, std::uint32_t nj, std::uint32_t nk) {
    StructuredGrid grid;
    grid.dims = {ni, nj, nk};
    for (std::uint32_t k = 0; k < nk; ++k) {
        for (std::uint32_t j = 0; j < nj; ++j) {
            for (std::uint32_t i = 0; i < ni; ++i) grid.points.push_back({2.0 * i, 3.0 * j, 5.0 * k});
        }
    }
    return grid;
}

TEST(VolumeOfAStructuredGrid, IsThatOfItsLivingCells) {
    StructuredGrid grid = box(4, 3, 2);
    EXPECT_DOUBLE_EQ(volume(grid), 6 * 30);
    grid.dead_cells.assign(6, 0);
    grid.dead_cells[4] = 1;
    EXPECT_DOUBLE_EQ(volume(grid), 5 * 30);
}

TEST(VolumeOfAStructuredGrid, DoesNotDependOnItsHandedness) {
    StructuredGrid grid = box(3, 3, 3);
    for (Vec3& p : grid.points) p[2] = -p[2];
    EXPECT_DOUBLE_EQ(volume(grid), 8 * 30);
}

TEST(VolumeOfAStructuredGrid, OfOneLayerOfPointsIsZero) {
    EXPECT_EQ(volume(box(4, 3, 1)), 0);
    EXPECT_EQ(volume(box(1, 1, 1)), 0);
}

TEST(VolumeOfAStructuredGrid, TakesSplitNodesForTheCellsThatUseThem) {
    // Two cells side by side; the plane between them is split at its four nodes and stands 1 to the right for the
    // right-hand cell (bit 0: the cell that starts at the node).
    StructuredGrid grid = box(3, 2, 2);
    for (std::uint32_t j = 0; j < 2; ++j) {
        for (std::uint32_t k = 0; k < 2; ++k) {
            const auto bit = static_cast<std::uint8_t>(1u << (2 * j + 4 * k));
            grid.splits.push_back({{1, j, k}, {3.0, 3.0 * j, 5.0 * k}, 0, bit});
        }
    }
    EXPECT_DOUBLE_EQ(volume(grid), 30 + 15);
}

TEST(VolumeOfARaster, IsThatOfTheBoxBetweenItsSamples) {
    Raster raster;
    raster.dims = {3, 4, 5};
    raster.step = {{{2, 0, 0}, {1, 3, 0}, {0, 0, -5}}};
    EXPECT_DOUBLE_EQ(volume(raster), 2 * 3 * 4 * 30);
    raster.coordinates = {{{0, 1, 7}, {0, 1, 2, 3}, {9, 8, 7, 6, 5}}};
    EXPECT_DOUBLE_EQ(volume(raster), 7 * 3 * 4);
    raster.dims = {3, 4, 1};
    EXPECT_EQ(volume(raster), 0);
}

}  // namespace
}  // namespace geomend
