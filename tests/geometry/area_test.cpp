// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/measures.h"

namespace geomend {
namespace {

Surface surface_of(std::vector<Vec3> points, const std::vector<std::vector<std::uint32_t>>& polygons) {
    Surface surface;
    surface.points = std::move(points);
    for (const auto& polygon : polygons) surface.polygons.push_back(polygon);
    return surface;
}

TEST(Area, OfTrianglesAddsUp) {
    const Surface s = surface_of({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 5}}, {{0, 1, 2}, {0, 1, 3}});
    EXPECT_DOUBLE_EQ(area(s), 6 + 7.5);
}

TEST(Area, OfAQuadrangleIsThatOfTheSplitAtItsLowestCorner) {
    // Raised at one corner: the two splits have different areas.
    const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}};
    const double at_0 = std::sqrt(2.0) / 2 * 2;    // triangles 0 1 2 and 0 2 3
    const double at_1 = 0.5 + std::sqrt(3.0) / 2;  // triangles 1 2 3 and 1 3 0
    EXPECT_DOUBLE_EQ(area(surface_of(p, {{0, 1, 2, 3}})), at_0);
    EXPECT_DOUBLE_EQ(area(surface_of(p, {{2, 3, 0, 1}})), at_0) << "where the list starts does not matter";
    EXPECT_DOUBLE_EQ(area(surface_of({p[1], p[2], p[3], p[0]}, {{0, 1, 2, 3}})), at_1);
}

TEST(Area, OfAFlatPolygonThatIsNotConvexIsRight) {
    // An L of area 3, its lowest corner at an end of the L: part of the fan is folded back.
    const std::vector<Vec3> p = {{2, 0, 7}, {2, 1, 7}, {1, 1, 7}, {1, 2, 7}, {0, 2, 7}, {0, 0, 7}};
    EXPECT_DOUBLE_EQ(area(surface_of(p, {{0, 1, 2, 3, 4, 5}})), 3);
    EXPECT_DOUBLE_EQ(area(surface_of({{0, 3, 0}, {1, 1, 0}, {3, 0, 0}, {0, 0, 0}}, {{0, 1, 2, 3}})), 3) << "a dart";
}

TEST(Area, DoesNotLoseDigitsFarFromTheOrigin) {
    const Surface s = surface_of({{4.5e5, 6.8e6, 1}, {4.5e5 + 0.5, 6.8e6, 1}, {4.5e5, 6.8e6 + 0.5, 1}}, {{0, 1, 2}});
    EXPECT_DOUBLE_EQ(area(s), 0.125);
}

TEST(Area, OfDegenerateFacesIsZero) { EXPECT_EQ(area(surface_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}, {0, 1}, {}})), 0); }

TEST(Area, OfAMeshCountsItsSurfaceCellsOnly) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 5}};
    mesh.add_cell(CellType::quad, std::vector<std::uint32_t>{0, 1, 2, 3});
    mesh.add_cell(CellType::triangle, std::vector<std::uint32_t>{0, 1, 4});
    mesh.add_cell(CellType::tetrahedron, std::vector<std::uint32_t>{0, 1, 3, 4});
    mesh.add_cell(CellType::quadratic_triangle, std::vector<std::uint32_t>{0, 1, 4, 5, 5, 5});
    mesh.add_cell(CellType::polygon, std::vector<std::uint32_t>{0, 1, 2, 3});
    EXPECT_DOUBLE_EQ(area(mesh), 3);
}

}  // namespace
}  // namespace geomend
