// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/connections.h"

#include <gtest/gtest.h>

#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

TEST(Connections, bricks_touch_their_neighbours_and_nobody_else) {
    const CornerPointGrid grid = testing::brick_grid(3, 4, 5);
    const Connections found = connections(grid);
    EXPECT_EQ(found.internal, 2u * 4 * 5 + 3 * 3 * 5 + 3 * 4 * 4);
    EXPECT_TRUE(found.others.empty());
    EXPECT_EQ(found.neighbours[0], Connections::east | Connections::south | Connections::below);
    EXPECT_EQ(found.neighbours[grid.cell(2, 3, 4)], 0);
}

TEST(Connections, half_a_layer_of_throw_joins_each_cell_to_two) {
    CornerPointGrid grid = testing::brick_grid(2, 1, 3);
    testing::add_throw(grid, 1, 5);
    const Connections found = connections(grid);
    // Right cell k lies beside left cells k and k+1; all but the last pair of the latter exist.
    EXPECT_EQ(found.others.size(), 2u);
    EXPECT_EQ(found.others[0], (NonNeighbour{2, 1, CellFace::i_plus}));
    EXPECT_EQ(found.others[1], (NonNeighbour{4, 3, CellFace::i_plus}));
    EXPECT_EQ(found.internal, 3u + 2 + 4);
}

TEST(Connections, a_whole_layer_of_throw_leaves_only_others) {
    CornerPointGrid grid = testing::brick_grid(2, 1, 3);
    testing::add_throw(grid, 1, 10);
    const Connections found = connections(grid);
    EXPECT_EQ(found.others.size(), 2u);
    EXPECT_EQ(found.neighbours[0] & Connections::east, 0);
    testing::add_throw(grid, 1, 20);
    EXPECT_TRUE(connections(grid).others.empty());
}

TEST(Connections, inactive_and_collapsed_cells_have_none) {
    CornerPointGrid grid = testing::brick_grid(1, 1, 3);
    grid.activity = {1, 0, 1};
    EXPECT_EQ(connections(grid).internal, 0u) << "a gap of 10 lies between";
    // Collapsed, it lets its neighbours touch, active or not.
    testing::reshape(grid, [](auto, auto, std::uint32_t k, unsigned c, double depth) {
        return k == 0 && c >= 4 ? 1020 : k == 1 ? 1020 : depth;
    });
    EXPECT_EQ(connections(grid).internal, 1u);
    grid.activity.clear();
    EXPECT_EQ(connections(grid).internal, 1u);
}

TEST(Connections, a_layer_pinched_out_beside_a_full_one_joins_across_layers) {
    // Layer 2 has no thickness on the right: its neighbours there lie higher by one layer's thickness.
    CornerPointGrid grid = testing::brick_grid(2, 1, 3);
    testing::reshape(grid, [](std::uint32_t i, auto, std::uint32_t k, unsigned c, double depth) {
        return i == 1 && (k == 2 || (k == 1 && c >= 4)) ? depth - 10 : depth;
    });
    const Connections found = connections(grid);
    ASSERT_EQ(found.others.size(), 1u);
    EXPECT_EQ(found.others[0], (NonNeighbour{2, 5, CellFace::i_plus}));
    EXPECT_NE(found.neighbours[1] & Connections::below, 0) << "past the pinched cell";
}

TEST(Connections, columns_out_of_order_are_searched_wholly) {
    CornerPointGrid ordered = testing::brick_grid(2, 2, 4);
    testing::add_throw(ordered, 1, 3);
    CornerPointGrid turned = ordered;  // layers upside down: the same touching cells by other numbers
    const std::uint32_t nz = ordered.dims[2];
    for (std::uint32_t k = 0; k < nz; ++k) {
        for (std::uint32_t j = 0; j < 2; ++j) {
            for (std::uint32_t i = 0; i < 2; ++i) {
                for (unsigned c = 0; c < 8; ++c)
                    turned.depths[corner_index(turned.dims, i, j, k, c)] = ordered.depths[corner_index(ordered.dims, i, j, nz - 1 - k, c)];
            }
        }
    }
    EXPECT_EQ(connections(turned).others.size(), connections(ordered).others.size());
}

}  // namespace
}  // namespace geomend::grid
