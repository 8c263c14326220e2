// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/flat_objects.h"

#include <gtest/gtest.h>

namespace geomend::topology {
namespace {

void add(CellMesh& mesh, CellType type, std::vector<std::uint32_t> nodes, std::uint32_t entity) {
    mesh.add_cell(type, nodes);
    mesh.cell_entity.push_back(entity);
}

// Two triangles of two surfaces on a common edge, its line and a corner; a loose line; a point that nothing uses.
CellMesh mesh() {
    CellMesh m;
    m.info.name = "m";
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 5}, {6, 5, 5}, {7, 5, 5}, {9, 9, 9}};
    m.point_labels.first = 10;
    m.entities.resize(5);
    m.entities[0] = {2, 1, "top", FeatureRole::horizon, "top", {}, {}, {}};
    m.entities[1] = {2, 2, "", FeatureRole::unknown, "", {}, {0}, {}};
    m.entities[2] = {1, 1, "", FeatureRole::unknown, "", {}, {}, {}};
    m.entities[3] = {0, 1, "", FeatureRole::unknown, "", {}, {}, {}};
    m.entities[4] = {1, 2, "trace", FeatureRole::unknown, "", {}, {}, {}};
    m.groups = {{2, 7, "base"}};
    add(m, CellType::triangle, {0, 1, 2}, 0);
    add(m, CellType::triangle, {1, 3, 2}, 1);
    add(m, CellType::line, {1, 2}, 2);
    add(m, CellType::vertex, {1}, 3);
    add(m, CellType::line, {4, 5}, 4);
    add(m, CellType::line, {5, 6}, 4);
    Attribute point, cell;
    point.name = "p";
    point.values = std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7};
    cell.name = "c";
    cell.location = AttributeLocation::cell;
    cell.values = std::vector<std::int32_t>{10, 11, 12, 13, 14, 15};
    m.info.attributes = {point, cell};
    return m;
}

TEST(FlatObjects, AreOnePerEntityWithNamesAndRoles) {
    std::vector<Loss> losses;
    const auto objects = flat_objects(mesh(), losses);
    ASSERT_EQ(objects.size(), 4u);
    EXPECT_EQ(info_of(objects[0]).name, "top");
    EXPECT_EQ(info_of(objects[0]).role, FeatureRole::horizon);
    EXPECT_EQ(info_of(objects[1]).name, "base");
    EXPECT_EQ(info_of(objects[2]).name, "trace");
    EXPECT_STREQ(kind_name(objects[0]), "surface");
    EXPECT_STREQ(kind_name(objects[2]), "polyline-set");
    const auto& loose = std::get<PointSet>(objects[3]);
    ASSERT_EQ(loose.points.size(), 1u);
    EXPECT_EQ(loose.points[0], (Vec3{9, 9, 9}));
    EXPECT_EQ(loose.labels[0], 17);
    EXPECT_EQ(losses.size(), 2u);  // the corner and the line between the surfaces
}

TEST(FlatObjects, TakeTheirPointsIdsAndValuesAlong) {
    std::vector<Loss> losses;
    const auto objects = flat_objects(mesh(), losses);
    const auto& base = std::get<Surface>(objects[1]);
    ASSERT_EQ(base.points.size(), 3u);
    EXPECT_EQ(base.points[2], (Vec3{1, 1, 0}));
    EXPECT_EQ(base.labels[2], 13);
    EXPECT_EQ(base.polygons.corners, (std::vector<std::uint32_t>{0, 2, 1}));
    EXPECT_EQ(std::get<std::vector<double>>(base.info.attributes[0].values), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(base.info.attributes[1].location, AttributeLocation::polygon);
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(base.info.attributes[1].values), (std::vector<std::int32_t>{11}));
    const auto& trace = std::get<PolylineSet>(objects[2]);
    EXPECT_EQ(trace.edges.size(), 2u);
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(trace.info.attributes[1].values), (std::vector<std::int32_t>{14, 15}));
}

TEST(FlatObjects, KeepEveryPointOfASingleObjectAndFindItsLines) {
    CellMesh m;
    m.info.name = "lines";
    m.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    add(m, CellType::line, {0, 1}, no_index);
    add(m, CellType::line, {1, 2}, no_index);
    add(m, CellType::line, {2, 0}, no_index);
    add(m, CellType::line, {3, 4}, no_index);
    std::vector<Loss> losses;
    const auto objects = flat_objects(m, losses);
    ASSERT_EQ(objects.size(), 1u);
    const auto& lines = std::get<PolylineSet>(objects[0]);
    EXPECT_EQ(lines.points.size(), 5u);
    ASSERT_EQ(lines.parts.size(), 2u);
    EXPECT_EQ(lines.parts[1].first_point, 3u);
    EXPECT_EQ(lines.parts[1].first_edge, 3u);
    EXPECT_TRUE(losses.empty());
}

TEST(FlatObjects, AreNotMadeOfVolumes) {
    CellMesh m = mesh();
    EXPECT_TRUE(has_no_volume_cells(m));
    add(m, CellType::tetrahedron, {0, 1, 2, 3}, no_index);
    EXPECT_FALSE(has_no_volume_cells(m));
    EXPECT_FALSE(has_no_volume_cells(CellMesh{}));
}

}  // namespace
}  // namespace geomend::topology
