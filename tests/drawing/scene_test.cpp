// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "support/corner_point_grids.h"
#include "topology/brep_from_dataset.h"
#include "topology/model_maker.h"

namespace geomend {
namespace {

using test::ModelMaker;

Finding about(const std::string& kind, const std::string& name, std::int64_t id = -1) {
    Finding f;
    f.code = "M03";
    f.entities = {{kind, name, id}};
    return f;
}

Finding listing(Finding f, std::vector<std::int64_t> index, const std::string& element_kind) {
    f.index = std::move(index);
    f.element_kind = element_kind;
    return f;
}

SceneMark mark_of(const Dataset& dataset, const Finding& f) {
    Scene scene = make_scene(dataset);
    mark_findings(scene, dataset, std::vector{f});
    return scene.marks.at(0);
}

double area(const ScenePart& part) {
    double sum = 0;
    for (const auto& [a, b, c] : part.triangles) {
        const Vec3 &p = part.points[a], &q = part.points[b], &r = part.points[c];
        const Vec3 u{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
        sum += 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    }
    return sum;
}

// Number of parts of each kind.
std::map<std::string, int> kinds(const Scene& scene) {
    std::map<std::string, int> count;
    for (const ScenePart& part : scene.parts) ++count[part.kind];
    return count;
}

TEST(Scene, OfABrepHasItsSurfacesLinesAndCornersWithTheirNumbers) {
    ModelMaker m = test::two_blocks();
    topology::build_breps(m.data);
    const Scene scene = make_scene(m.data);
    EXPECT_EQ(kinds(scene), (std::map<std::string, int>{{"corner", 12}, {"line", 20}, {"surface", 11}}));
    const auto middle = std::ranges::find_if(scene.parts, [](const ScenePart& p) { return p.role == FeatureRole::horizon; });
    ASSERT_NE(middle, scene.parts.end());
    EXPECT_EQ(area(*middle), 1);
    EXPECT_EQ(middle->id, 2);
    EXPECT_EQ(scene.triangles, 22u);
    EXPECT_EQ(scene.marks.size(), 0u);
}

TEST(Scene, MarksTheTrianglesOfTheSurfaceThatIsMeant) {
    ModelMaker m = test::two_blocks();
    topology::build_breps(m.data);
    const std::string name = m.data.breps[0]->surfaces[2].name;
    const SceneMark mark = mark_of(m.data, listing(about("surface", name, 2), {1, 7, -1}, "triangle"));
    ASSERT_EQ(mark.triangles.size(), 1u) << "what is out of range is left out";
    for (const Vec3& p : mark.triangles[0]) EXPECT_EQ(p[2], 1);
    ASSERT_EQ(mark.outlines.size(), 1u);
    EXPECT_EQ(mark.outlines[0].front(), mark.outlines[0].back());
}

TEST(Scene, MarksWholeLinesAndCorners) {
    ModelMaker m = test::two_blocks();
    topology::build_breps(m.data);
    const auto& brep = *m.data.breps[0];
    const SceneMark line = mark_of(m.data, about("line", brep.lines[3].name, 3));
    ASSERT_EQ(line.polylines.size(), 1u);
    EXPECT_EQ(line.polylines[0].front(), brep.vertices[brep.lines[3].vertices.front().value]);
    const SceneMark corner = mark_of(m.data, about("corner", brep.corners[5].name, 5));
    ASSERT_EQ(corner.points.size(), 1u);
    EXPECT_EQ(corner.points[0], brep.vertices[brep.corners[5].vertex.value]);
    const SceneMark lines = mark_of(m.data, listing(about("region", brep.regions[0].name, 0), {0, 1, 2}, "line"));
    EXPECT_EQ(lines.polylines.size(), 3u);
}

TEST(Scene, PointsAndLinesOfAFindingAreItsMarkWhateverItIsAbout) {
    Finding f = about("nothing", "that is there");
    f.points = {{1, 2, 3}};
    f.polylines = {{{0, 0, 0}, {1, 1, 1}}};
    const SceneMark mark = mark_of(Dataset{}, f);
    EXPECT_EQ(mark.points, f.points);
    EXPECT_EQ(mark.polylines, f.polylines);
}

TEST(Scene, OfAGridIsItsOutside) {
    Dataset data;
    CornerPointGrid grid = testing::brick_grid(3, 2, 4);
    data.objects.emplace_back(grid);
    const Scene scene = make_scene(data);
    double whole = 0;
    for (const ScenePart& part : scene.parts) {
        whole += area(part);
        EXPECT_EQ(part.role, FeatureRole::boundary) << part.name;
        for (const Vec3& p : part.points) EXPECT_LE(p[2], -1000) << "elevation-up";
    }
    EXPECT_EQ(scene.parts.size(), 6u);
    EXPECT_DOUBLE_EQ(whole, 2 * (300 * 200 + 300 * 40 + 200 * 40));
    EXPECT_EQ(scene.triangles, 2u * 2 * (3 * 2 + 3 * 4 + 2 * 4));
}

TEST(Scene, OfAGridShowsBothSidesOfAFaultAndItsName) {
    Dataset data;
    CornerPointGrid grid = testing::brick_grid(4, 2, 3);
    testing::add_throw(grid, 2, 15);
    data.objects.emplace_back(grid);
    const auto fault_area = [](const Scene& scene, const std::string& name) {
        for (const ScenePart& part : scene.parts) {
            if (part.name == name && part.role == FeatureRole::fault) return area(part);
        }
        return -1.0;
    };
    EXPECT_DOUBLE_EQ(fault_area(make_scene(data), "unnamed throw"), 2 * 200 * 30);
    std::get<CornerPointGrid>(data.objects[0]).faults = {{"F1", {{{1, 0, 0}, {1, 1, 2}, CellFace::i_plus}}, {}}};
    const Scene named = make_scene(data);
    EXPECT_DOUBLE_EQ(fault_area(named, "F1"), 2 * 200 * 30);
    EXPECT_EQ(fault_area(named, "unnamed throw"), -1);
}

TEST(Scene, LeavesOutCellsWithoutAPlace) {
    Dataset data;
    CornerPointGrid grid = testing::brick_grid(2, 2, 2);
    grid.depths[corner_index(grid.dims, 0, 0, 0, 0)] = std::numeric_limits<double>::quiet_NaN();
    grid.depths[corner_index(grid.dims, 1, 0, 0, 0)] = 1e20;
    data.objects.emplace_back(grid);
    Scene scene = make_scene(data);
    for (const ScenePart& part : scene.parts) {
        for (const Vec3& p : part.points) EXPECT_TRUE(std::abs(p[2]) < 2000);
    }
    EXPECT_FALSE(scene.parts.empty());
    mark_findings(scene, data, std::vector{listing(about("corner-point-grid", "bricks"), {0, 1, 2}, "cell-ijk")});
    EXPECT_EQ(scene.marks[0].triangles.size(), 12u) << "cell 2 alone";
}

TEST(Scene, OfAGridThatDoesNotFitIsEmpty) {
    Dataset data;
    CornerPointGrid grid = testing::brick_grid(2, 2, 2);
    grid.depths.pop_back();
    data.objects.emplace_back(grid);
    Scene scene = make_scene(data);
    EXPECT_TRUE(scene.parts.empty());
    mark_findings(scene, data, std::vector{listing(about("corner-point-grid", "bricks"), {0}, "cell-ijk")});
    EXPECT_TRUE(scene.marks[0].empty());
}

TEST(Scene, MarksCellsColumnsAndPillarsOfAGrid) {
    Dataset data;
    data.objects.emplace_back(testing::brick_grid(3, 2, 4));
    const SceneMark cell = mark_of(data, listing(about("corner-point-grid", "bricks"), {0, 23}, "cell-ijk"));
    EXPECT_EQ(cell.triangles.size(), 24u);
    EXPECT_EQ(cell.outlines.size(), 12u);
    Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (std::size_t t = 12; t < 24; ++t) {
        for (const Vec3& p : cell.triangles[t]) {
            for (std::size_t a = 0; a < 3; ++a) {
                low[a] = std::min(low[a], p[a]);
                high[a] = std::max(high[a], p[a]);
            }
        }
    }
    EXPECT_EQ(low, (Vec3{200, 100, -1040}));
    EXPECT_EQ(high, (Vec3{300, 200, -1030}));
    const SceneMark pillar = mark_of(data, listing(about("corner-point-grid", "bricks"), {5, 0}, "pillar-ij"));
    ASSERT_EQ(pillar.polylines.size(), 2u);
    EXPECT_EQ(pillar.polylines[0], (std::vector<Vec3>{{100, 100, -1000}, {100, 100, -1040}}));
    EXPECT_EQ(pillar.polylines[1], (std::vector<Vec3>{{0, 0, -1000}, {0, 0, -1040}}));
    const SceneMark column = mark_of(data, listing(about("corner-point-grid", "bricks"), {4}, "column-ij"));
    EXPECT_EQ(column.triangles.size(), 12u);
    EXPECT_TRUE(mark_of(data, listing(about("corner-point-grid", "other"), {4}, "cell-ijk")).empty());
}

TEST(Scene, OfCellsIsTheirOutside) {
    // Two cubes side by side: of twelve sides ten are outside.
    CellMesh mesh;
    mesh.info.name = "cells";
    for (int z = 0; z < 2; ++z) {
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 3; ++x) mesh.points.push_back({double(x), double(y), double(z)});
        }
    }
    for (std::uint32_t x = 0; x < 2; ++x)
        mesh.add_cell(CellType::hexahedron, std::array{x, x + 1, x + 4, x + 3, x + 6, x + 7, x + 10, x + 9});
    Dataset data;
    data.objects.emplace_back(mesh);
    const Scene scene = make_scene(data);
    ASSERT_EQ(scene.parts.size(), 1u);
    EXPECT_EQ(area(scene.parts[0]), 10);
    EXPECT_EQ(mark_of(data, listing(about("cell-mesh", "cells"), {1}, "hexahedron")).triangles.size(), 12u);
}

TEST(Scene, OfAHorizonGridHasHolesWhereThereIsNoData) {
    Raster raster;
    raster.info.name = "h";
    raster.dims = {4, 3, 1};
    Attribute height;
    height.name = "z";
    height.no_data = 1e30;
    std::vector<double> values(12, 5.0);
    values[0] = 1e30;
    height.values = values;
    raster.info.attributes.push_back(height);
    raster.height_attribute = 0;
    Dataset data;
    data.objects.emplace_back(raster);
    const Scene scene = make_scene(data);
    ASSERT_EQ(scene.parts.size(), 1u);
    EXPECT_EQ(scene.parts[0].triangles.size(), 10u);
    for (const Vec3& p : scene.parts[0].points) EXPECT_EQ(p[2], 5);
}

TEST(Scene, DrawsWhatHasNoFacesToo) {
    Dataset data;
    PointSet points;
    points.points = {{0, 0, 0}};
    PolylineSet lines;
    lines.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    lines.edges = {{0, 1}, {1, 2}, {3, 0}};
    Well well;
    well.path = {{0, 0, 0}, {0, 0, -5}};
    data.objects = {points, lines, well, Raster{}, StructuredGrid{}, CellMesh{}, Surface{}};
    const Scene scene = make_scene(data);
    EXPECT_EQ(scene.parts[1].polylines, (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {3, 0}}));
    EXPECT_EQ(scene.parts[2].polylines.size(), 1u);
}

}  // namespace
}  // namespace geomend
