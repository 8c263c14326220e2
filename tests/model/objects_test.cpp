// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/objects.h"

#include <gtest/gtest.h>

#include <array>

namespace geomend {
namespace {

TEST(Polygons, AreTrianglesUntilAnotherComes) {
    Polygons p;
    p.push_back(std::array<std::uint32_t, 3>{0, 1, 2});
    EXPECT_TRUE(p.all_triangles());
    p.push_back(std::array<std::uint32_t, 4>{0, 1, 2, 3});
    p.push_back(std::array<std::uint32_t, 3>{3, 1, 2});
    ASSERT_EQ(p.size(), 3u);
    EXPECT_EQ(p[0].size(), 3u);
    EXPECT_EQ(p[1].size(), 4u);
    EXPECT_EQ(p[2][0], 3u);
}

TEST(Polygons, MayBeginWithAQuadrangle) {
    Polygons p;
    p.push_back(std::array<std::uint32_t, 4>{0, 1, 2, 3});
    ASSERT_EQ(p.size(), 1u);
    EXPECT_EQ(p[0].size(), 4u);
}

TEST(CellTypes, KnowTheirShape) {
    EXPECT_EQ(node_count(CellType::wedge), 6u);
    EXPECT_EQ(dimension(CellType::quadratic_triangle), 2);
    EXPECT_EQ(linear_type(CellType::quadratic_tetrahedron), CellType::tetrahedron);
    EXPECT_TRUE(is_second_order(CellType::quadratic_edge));
    EXPECT_FALSE(is_second_order(CellType::polyhedron));
}

TEST(Lattice, CountsSamplesAndCells) {
    EXPECT_EQ(sample_count({4, 3, 2}), 24u);
    EXPECT_EQ(lattice_cell_count({4, 3, 2}), 6u);
    EXPECT_EQ(lattice_cell_count({4, 3, 1}), 6u);
    EXPECT_EQ(lattice_cell_count({1, 1, 1}), 0u);
}

TEST(Raster, PlacesItsSamples) {
    Raster r;
    r.dims = {4, 3, 2};
    r.origin = {100, 200, 0};
    r.step = {{{10, 0, 0}, {0, 10, 0}, {0, 0, -10}}};
    EXPECT_EQ(sample_position(r, 3, 2, 1), (Vec3{130, 220, -10}));
}

}  // namespace
}  // namespace geomend
