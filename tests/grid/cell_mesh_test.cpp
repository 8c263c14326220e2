// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "geometry/measures.h"
#include "grid/cell_geometry.h"
#include "grid/connections.h"
#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

CornerPointGrid leaning_faulted() {
    CornerPointGrid grid = testing::brick_grid(4, 3, 3);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) {
        grid.pillars[p + 3] += 7 + 0.01 * double(p);
        grid.pillars[p + 4] -= 3;
    }
    testing::add_throw(grid, 2, 13);
    // Layers dip differently on both sides, so that edges cross off the pillars.
    testing::reshape(grid, [](std::uint32_t i, std::uint32_t j, auto, unsigned c, double depth) {
        const double y = j + ((c >> 1) & 1u);
        return depth + (i >= 2 ? -9 * y : 4 * y);
    });
    return grid;
}

std::size_t count(const CellMesh& mesh, CellType type) { return static_cast<std::size_t>(std::ranges::count(mesh.types, type)); }

// Each edge of each cell's faces is used once in each direction.
bool every_cell_closes(const CellMesh& mesh) {
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (std::uint64_t f = mesh.cell_faces[c]; f < mesh.cell_faces[c + 1]; ++f) {
            const std::uint64_t first = mesh.face_offsets[f], last = mesh.face_offsets[f + 1];
            for (std::uint64_t n = first; n < last; ++n) ++edges[{mesh.face_nodes[n], mesh.face_nodes[n + 1 < last ? n + 1 : first]}];
        }
        for (const auto& [edge, times] : edges) {
            if (times != 1 || edges[{edge.second, edge.first}] != 1) return false;
        }
    }
    return true;
}

TEST(PlainCells, bricks_are_hexahedra_with_positive_volume_whatever_the_hand) {
    CornerPointGrid grid = testing::brick_grid(2, 2, 2);
    for (int hand = 0; hand < 2; ++hand) {
        const Cells cells = plain_cells(grid);
        EXPECT_EQ(count(cells.mesh, CellType::hexahedron), 8u);
        EXPECT_EQ(cells.mesh.points.size(), 27u);
        for (std::size_t c = 0; c < 8; ++c) EXPECT_DOUBLE_EQ(cell_volume(cells.mesh, c), 1e5);
        for (std::size_t p = 0; p < grid.pillars.size(); p += 3) grid.pillars[p] = -grid.pillars[p];
    }
}

TEST(PlainCells, a_cell_pinched_on_one_side_is_a_wedge) {
    CornerPointGrid grid = testing::brick_grid(1, 1, 1);
    for (const unsigned c : {5u, 7u}) grid.depths[corner_index(grid.dims, 0, 0, 0, c)] = 1000;
    const Cells cells = plain_cells(grid);
    ASSERT_EQ(count(cells.mesh, CellType::wedge), 1u);
    EXPECT_NEAR(cell_volume(cells.mesh, 0), 5e4, 1e-9);
}

TEST(PlainCells, cells_pinched_elsewhere_are_closed_polyhedra) {
    for (const auto& pinched : {std::vector<unsigned>{4}, {4, 7}, {4, 5, 6}}) {
        CornerPointGrid grid = testing::brick_grid(1, 1, 1);
        for (const unsigned c : pinched) grid.depths[corner_index(grid.dims, 0, 0, 0, c)] = 1000;
        const Cells cells = plain_cells(grid);
        ASSERT_EQ(count(cells.mesh, CellType::polyhedron), 1u);
        EXPECT_TRUE(every_cell_closes(cells.mesh));
        EXPECT_GT(cell_volume(cells.mesh, 0), 0);
    }
}

TEST(PlainCells, carry_their_place_in_the_grid_and_all_attributes) {
    CornerPointGrid grid = testing::brick_grid(2, 2, 2);
    grid.activity = {1, 0, 1, 1, 1, 1, 1, 1};
    testing::add_constant(grid, "PORO", 0.25);
    const Cells cells = plain_cells(grid);
    ASSERT_EQ(cells.mesh.cell_count(), 7u);
    const auto value = [&](const char* name, std::size_t cell) {
        return value_as_double(*find_attribute(cells.mesh.info.attributes, name, AttributeLocation::cell), cell);
    };
    EXPECT_EQ(value("I", 1), 1);
    EXPECT_EQ(value("J", 1), 2);
    EXPECT_EQ(value("K", 1), 1);
    EXPECT_EQ(value("GlobalIndex", 1), 3);
    EXPECT_EQ(value("ActiveIndex", 1), 2);
    EXPECT_EQ(value("PORO", 6), 0.25);
}

TEST(PlainCells, collapsed_cells_are_listed_and_make_none) {
    CornerPointGrid grid = testing::brick_grid(1, 1, 2);
    testing::reshape(grid, [](auto, auto, std::uint32_t k, auto, double depth) { return k == 1 ? 1010 : depth; });
    const Cells cells = plain_cells(grid);
    EXPECT_EQ(cells.mesh.cell_count(), 1u);
    EXPECT_EQ(cells.collapsed, std::vector<std::uint32_t>{1});
}

TEST(ConformingCells, each_face_is_shared_by_the_cells_that_touch) {
    const CornerPointGrid grid = leaning_faulted();
    const GridFaces faces = conforming_faces(grid);
    EXPECT_EQ(faces.unmatched_columns, 0u);
    std::uint64_t shared = 0;
    for (const auto& face : faces.faces) shared += face.second != 0xffffffffu;
    EXPECT_EQ(shared, connections(grid).internal);
}

TEST(ConformingCells, every_cell_closes_and_volumes_add_up_to_the_outer_surface) {
    for (int hand = 0; hand < 2; ++hand) {
        CornerPointGrid grid = leaning_faulted();
        if (hand == 1)
            for (std::size_t p = 0; p < grid.pillars.size(); p += 3) grid.pillars[p] = -grid.pillars[p];
        const Cells cells = conforming_cells(grid);
        EXPECT_TRUE(every_cell_closes(cells.mesh));
        double sum = 0;
        for (std::size_t c = 0; c < cells.mesh.cell_count(); ++c) {
            EXPECT_GT(cell_volume(cells.mesh, c), 0);
            sum += cell_volume(cells.mesh, c);
        }
        EXPECT_NEAR(sum, volume(grid), 2e-3 * sum) << "faces are bent, and triangles follow them roughly";
    }
}

TEST(ConformingCells, bricks_with_a_throw_keep_their_volume_exactly) {
    CornerPointGrid grid = testing::brick_grid(2, 1, 3);
    testing::add_throw(grid, 1, 5);
    const Cells cells = conforming_cells(grid);
    for (std::size_t c = 0; c < cells.mesh.cell_count(); ++c) EXPECT_NEAR(cell_volume(cells.mesh, c), 1e5, 1e-7);
    EXPECT_TRUE(every_cell_closes(cells.mesh));
}

TEST(ConformingCells, gaps_and_grid_edges_stay_open) {
    CornerPointGrid grid = testing::brick_grid(2, 1, 3);
    grid.activity = {1, 1, 0, 1, 1, 1};
    const GridFaces faces = conforming_faces(grid);
    // The right cell of layer 2 looks into the gap on its left.
    bool open = false;
    for (const auto& face : faces.faces) open = open || (face.first == 3 && face.side == CellFace::i_minus && face.second == 0xffffffffu);
    EXPECT_TRUE(open);
    EXPECT_TRUE(every_cell_closes(conforming_cells(grid).mesh));
}

}  // namespace
}  // namespace geomend::grid
