// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/from_cells.h"

#include <gtest/gtest.h>

#include "grid/cell_geometry.h"
#include "grid/cell_mesh.h"
#include "grid/connections.h"
#include "support/corner_point_grids.h"

namespace geomend::grid {
namespace {

CornerPointGrid varied() {
    CornerPointGrid grid = testing::brick_grid(4, 3, 3);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) grid.pillars[p + 3] += 12;
    testing::add_throw(grid, 2, 13);
    testing::add_constant(grid, "PORO", 0.2);
    grid.activity.assign(grid.cell_count(), 1);
    grid.activity[5] = grid.activity[20] = 0;
    // A wedge in the first column.
    for (const unsigned c : {5u, 7u})
        grid.depths[corner_index(grid.dims, 0, 0, 2, c)] = grid.depths[corner_index(grid.dims, 0, 0, 2, c - 4)];
    return grid;
}

void expect_same_cells(const CornerPointGrid& a, const CornerPointGrid& b) {
    ASSERT_EQ(a.dims, b.dims);
    ASSERT_EQ(active_count(a), active_count(b));
    for (std::size_t c = 0; c < a.cell_count(); ++c) {
        ASSERT_EQ(a.is_active(c), b.is_active(c));
        if (!a.is_active(c)) continue;
        const auto [i, j, k] = a.ijk(c);
        const Corners p = cell_corners(a, i, j, k), q = cell_corners(b, i, j, k);
        for (std::size_t n = 0; n < 8; ++n) {
            EXPECT_EQ(p[n][2], q[n][2]);
            for (std::size_t d = 0; d < 2; ++d) EXPECT_NEAR(p[n][d], q[n][d], 1e-9);
        }
    }
}

TEST(FromTaggedCells, plain_cells_become_the_grid_that_they_came_from) {
    for (int hand = 0; hand < 2; ++hand) {
        CornerPointGrid grid = varied();
        if (hand == 1)
            for (std::size_t p = 0; p < grid.pillars.size(); p += 3) grid.pillars[p] = -grid.pillars[p];
        const auto back = from_tagged_cells(plain_cells(grid).mesh);
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        expect_same_cells(grid, *back);
        EXPECT_NE(find_attribute(back->info.attributes, "PORO", AttributeLocation::cell), nullptr);
        EXPECT_EQ(find_attribute(back->info.attributes, "I", AttributeLocation::cell), nullptr);
        EXPECT_EQ(connections(grid).others, connections(*back).others);
    }
}

// Layers that wedge out towards a corner: no cell of the last columns is a hexahedron, and their last pillar stands in
// pinched cells only.
TEST(FromTaggedCells, columns_without_a_hexahedron_come_back_from_their_neighbours) {
    CornerPointGrid grid = testing::brick_grid(4, 4, 3);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) grid.pillars[p + 3] += 3 + 0.05 * double(p);
    testing::reshape(grid, [](std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c, double) {
        const std::uint32_t x = i + (c & 1u), y = j + ((c >> 1) & 1u);
        const double thickness = (x >= 3 && y >= 3) || (x == 4 && y >= 2) ? 0.0 : 10.0;
        return 1000 + thickness * (k + (c >> 2)) + (k == 2 && c >= 4 && thickness == 0 && x == 3 ? 4.0 : 0.0);
    });
    const CellMesh mesh = plain_cells(grid).mesh;
    const auto back = from_tagged_cells(mesh);
    ASSERT_TRUE(back.ok()) << back.why().error.message;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const auto at = [&](const char* name) {
            return static_cast<std::uint32_t>(value_as_double(*find_attribute(mesh.info.attributes, name, AttributeLocation::cell), c) - 1);
        };
        const Corners p = cell_corners(grid, at("I"), at("J"), at("K")), q = cell_corners(*back, at("I"), at("J"), at("K"));
        for (std::size_t n = 0; n < 8; ++n) {
            for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(p[n][d], q[n][d], 1e-9);
        }
    }
}

TEST(FromTaggedCells, a_cell_off_its_pillars_is_named) {
    CellMesh mesh = plain_cells(testing::brick_grid(2, 2, 3)).mesh;
    // The first point of the second level of some pillar steps aside.
    mesh.points[1][0] += 5;
    const auto back = from_tagged_cells(mesh);
    ASSERT_FALSE(back.ok());
    EXPECT_NE(back.why().error.message.find("cell (1,1,1)"), std::string::npos) << back.why().error.message;
}

TEST(FromTaggedCells, two_cells_at_one_place_are_refused) {
    CellMesh mesh = plain_cells(testing::brick_grid(2, 1, 1)).mesh;
    for (Attribute& a : mesh.info.attributes) {
        if (a.name == "I") std::get<std::vector<std::int32_t>>(a.values)[1] = 1;
    }
    const auto back = from_tagged_cells(mesh);
    ASSERT_FALSE(back.ok());
    EXPECT_NE(back.why().error.message.find("twice"), std::string::npos);
}

StructuredGrid lattice(bool upwards) {
    StructuredGrid grid;
    grid.dims = {3, 3, 3};
    for (std::uint32_t k = 0; k < 3; ++k) {
        for (std::uint32_t j = 0; j < 3; ++j) {
            for (std::uint32_t i = 0; i < 3; ++i)
                grid.points.push_back({100.0 * i + 3.0 * k, 100.0 * j, upwards ? -1020.0 + 10 * k : -1000.0 - 10 * k});
        }
    }
    Attribute a;
    a.name = "layer";
    a.location = AttributeLocation::cell;
    a.values = std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1};
    grid.info.attributes.push_back(a);
    return grid;
}

TEST(FromStructured, straight_columns_become_pillars) {
    const auto grid = from_structured(lattice(false));
    ASSERT_TRUE(grid.ok());
    EXPECT_EQ(grid->dims, (std::array<std::uint32_t, 3>{2, 2, 2}));
    EXPECT_NEAR(volume(*grid), 8e5, 1e-6);
    EXPECT_EQ(cell_corners(*grid, 0, 0, 0)[0], (Vec3{0, 0, 1000}));
}

TEST(FromStructured, layers_that_run_upwards_are_turned_with_their_values) {
    const auto grid = from_structured(lattice(true));
    ASSERT_TRUE(grid.ok());
    EXPECT_EQ(cell_corners(*grid, 0, 0, 0)[0][2], 1000);
    EXPECT_EQ(value_as_double(grid->info.attributes[0], 0), 1);
}

TEST(FromStructured, a_bent_column_is_refused_with_its_cell) {
    StructuredGrid bent = lattice(false);
    bent.points[9 + 4][0] += 1;
    const auto grid = from_structured(bent);
    ASSERT_FALSE(grid.ok());
    EXPECT_EQ(grid.why().kind, FailureKind::cannot_hold);
    EXPECT_NE(grid.why().error.message.find("cell (1,1,1)"), std::string::npos) << grid.why().error.message;
}

TEST(PutAttributes, values_go_to_their_cells_and_the_rest_is_missing) {
    CornerPointGrid grid = testing::brick_grid(2, 2, 1);
    grid.activity = {1, 0, 1, 1};
    CellMesh mesh = plain_cells(grid).mesh;
    Attribute result;
    result.name = "PRESSURE";
    result.location = AttributeLocation::cell;
    result.values = std::vector<float>{1, 3, 4};
    mesh.info.attributes.push_back(result);
    ASSERT_TRUE(put_attributes(mesh, grid).ok());
    const Attribute* a = find_attribute(grid.info.attributes, "PRESSURE", AttributeLocation::cell);
    ASSERT_NE(a, nullptr);
    EXPECT_EQ(value_as_double(*a, 2), 3);
    EXPECT_TRUE(is_no_data(*a, value_as_double(*a, 1)));
}

}  // namespace
}  // namespace geomend::grid
