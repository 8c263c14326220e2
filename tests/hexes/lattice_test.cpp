// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "base/vectors.h"
#include "hexes/main_axes.h"
#include "hexes/sampling.h"
#include "remesh/edge_mesh.h"

// Boxes, however they are turned, have a lattice that fits them; its points and samples are counted.

namespace geomend::hexes {
namespace {

using Axes = std::array<Vec3, 3>;

Axes turned(double about_z, double about_x) {
    const double c = std::cos(about_z), s = std::sin(about_z), u = std::cos(about_x), w = std::sin(about_x);
    return {{{c, s, 0}, {-s * u, c * u, w}, {s * w, -c * w, u}}};
}

Vec3 at(const Axes& axes, const Vec3& origin, const Vec3& p) {
    return plus(origin, plus(times(p[0], axes[0]), plus(times(p[1], axes[1]), times(p[2], axes[2]))));
}

/// The corners of a box and its twelve triangles, normals outwards.
struct Box {
    std::vector<Vec3> places;
    std::vector<Triangle> triangles;
};

Box box_of(const Axes& axes, const Vec3& origin, const Vec3& edges) {
    Box box;
    for (unsigned k = 0; k < 8; ++k)
        box.places.push_back(at(axes, origin, {(k & 1) * edges[0], (k >> 1 & 1) * edges[1], (k >> 2) * edges[2]}));
    const std::array<std::array<std::uint32_t, 4>, 6> quads{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& q : quads) {
        box.triangles.push_back({q[0], q[1], q[2]});
        box.triangles.push_back({q[0], q[2], q[3]});
    }
    return box;
}

BrepData brep_of(const Box& box) {
    BrepData brep;
    brep.vertices = box.places;
    BrepData::Surface& surface = brep.surfaces.emplace_back();
    for (std::uint32_t v = 0; v < 8; ++v) surface.nodes.push_back(VertexId(v));
    for (const Triangle& t : box.triangles) surface.polygons.push_back(t);
    return brep;
}

volumes::RegionFacets facets_of(const Box& box) {
    volumes::RegionFacets facets;
    facets.positions = box.places;
    facets.triangles = box.triangles;
    facets.sides.assign(box.triangles.size(), volumes::behind);
    facets.surfaces.assign(box.triangles.size(), 0);
    return facets;
}

TEST(Lattice, MainAxesAreThoseOfABoxHoweverItIsTurned) {
    for (const auto& [about_z, about_x] : std::vector<std::pair<double, double>>{{0, 0}, {0.3, 0}, {0.7853, 0}, {1.2, 0.4}, {-0.5, 0.6}}) {
        const Axes axes = turned(about_z, about_x);
        const auto found = main_axes(brep_of(box_of(axes, {512000, 6123000, -2000}, {30, 20, 10})));
        for (const Vec3& a : axes) {
            double most = 0;
            for (const Vec3& f : found) most = std::max(most, std::abs(dot(a, f)));
            EXPECT_NEAR(most, 1, 1e-9) << about_z << ' ' << about_x;
        }
        EXPECT_NEAR(dot(found[0], cross(found[1], found[2])), 1, 1e-12);
    }
}

TEST(Lattice, AxesStayWhereASideIsTiltedALittle) {
    Box box = box_of(turned(0.2, 0), {0, 0, 0}, {100, 100, 100});
    for (std::size_t k = 4; k < 8; ++k) box.places[k][2] += 0.01 * box.places[k][0];
    const auto found = main_axes(brep_of(box));
    EXPECT_GT(std::abs(found[2][2]), 0.999);
    EXPECT_NEAR(std::abs(found[0][0]), std::cos(0.2), 1e-3);
}

TEST(Lattice, AxesAreThoseOfTheWallsWhereLayersInsideDip) {
    // Three sheets across the box, with more area than its walls together and all of them tilted alike.
    const Axes axes = turned(0.4, 0);
    const Vec3 origin{512000, 6123000, -2000};
    BrepData brep = brep_of(box_of(axes, origin, {300, 200, 100}));
    for (const double height : {30, 50, 60}) {
        BrepData::Surface& sheet = brep.surfaces.emplace_back();
        for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(300.0, 0.0), std::pair(300.0, 200.0), std::pair(0.0, 200.0)}) {
            sheet.nodes.push_back(VertexId(brep.vertices.size()));
            brep.vertices.push_back(at(axes, origin, {x, y, height + 0.1 * x}));
        }
        sheet.polygons.push_back(Triangle{0, 1, 2});
        sheet.polygons.push_back(Triangle{0, 2, 3});
    }
    const Axes found = main_axes(brep);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(dot(axes[k], found[k])), 1, 1e-12) << k;
}

TEST(LatticeSampling, LinesAreNotPartedByTheThinnestOfLayers) {
    // Layers from 0.4 to 1.6 steps high: along the columns' rows a step is a step.
    std::vector<ColumnSpan> columns;
    for (std::int64_t i = 0; i <= 12; ++i) {
        for (std::int64_t j = 0; j <= 4; ++j) columns.push_back({i, j, 0, 2 + 0.5 * static_cast<double>(i)});
    }
    Lattice lattice{{0, 0, 0}, turned(0, 0), {1, 1, 1}, Layers::of(columns, columns.size()), 1};
    ASSERT_TRUE(lattice.layers);
    ASSERT_LT(lattice.least_step(), 0.6);
    remeshing::LineRules rules;
    rules.max_distance = 0.1;
    const std::vector<Vec3> level{{0, 0, 0}, {12, 0, 0}};
    EXPECT_EQ(lattice_line(lattice, level, rules).size(), 13u);
    const std::vector<Vec3> upright{{12, 0, 0}, {12, 0, 8}};
    EXPECT_EQ(lattice_line(lattice, upright, rules).size(), 1 + static_cast<std::size_t>(lattice.layers->count()));
}

/// A lattice whose layers narrow from 8 steps together to 2, over 12 columns.
Lattice wedge_lattice() {
    std::vector<ColumnSpan> columns;
    for (std::int64_t i = 0; i <= 12; ++i) {
        for (std::int64_t j = 0; j <= 4; ++j) columns.push_back({i, j, 0, 8 - 0.5 * static_cast<double>(i)});
    }
    return {{0, 0, 0}, turned(0, 0), {1, 1, 1}, Layers::of(columns, columns.size()), 1};
}

TEST(LatticeSampling, PointsOfAWallLieOnLayersThatNarrow) {
    // Two triangles for all of a wall: levels do not change evenly between their corners.
    const Lattice lattice = wedge_lattice();
    ASSERT_TRUE(lattice.layers);
    const std::vector<Vec3> places{{0, 2, 0}, {12, 2, 0}, {12, 2, 2}, {0, 2, 8}};
    const auto mesh = remeshing::fanned_mesh(places, std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3},
                                             std::vector<std::uint32_t>{no_index, no_index, 1, 0, no_index, no_index});
    ASSERT_TRUE(mesh);
    const auto points = lattice_surface(lattice, mesh->mesh, {});
    EXPECT_EQ(points.size(), 11u * (static_cast<std::size_t>(lattice.layers->count()) - 1));
    for (const auto& point : points) {
        const Vec3& p = point.place;
        const double level = lattice.layers->count() * p[2] / (8 - 0.5 * p[0]);
        EXPECT_NEAR(p[0], std::round(p[0]), 1e-9);
        EXPECT_NEAR(level, std::round(level), 1e-9) << p[0];
    }
}

TEST(LatticeSampling, SoDoThoseOfALineAcrossThem) {
    const Lattice lattice = wedge_lattice();
    const std::vector<Vec3> line{{3, 2, 0}, {5, 2, 5.5}};
    remeshing::LineRules rules;
    rules.max_distance = 0.1;
    const auto samples = lattice_line(lattice, line, rules);
    ASSERT_EQ(samples.size(), 1 + static_cast<std::size_t>(lattice.layers->count()));
    for (const auto& sample : samples) {
        const Vec3 p = remeshing::place_of(line, sample);
        const double level = lattice.layers->count() * p[2] / (8 - 0.5 * p[0]);
        EXPECT_NEAR(level, std::round(level), 1e-9);
    }
}

TEST(Lattice, AlongLayersPlacesTurnAsTheyDoWhereTheyAre) {
    // Four points of a square across the slope of a layer that narrows: in level layers they would lie in a plane.
    const Lattice lattice = wedge_lattice();
    ASSERT_TRUE(lattice.layers);
    const std::vector<Vec3> places{lattice.place({3, 1, 1}), lattice.place({4, 1, 1}), lattice.place({3, 2, 2}), lattice.place({4, 2, 2})};
    const auto level = along_layers(lattice, places);
    ASSERT_EQ(level.size(), 4u);
    const auto turn = [](std::span<const Vec3> p) { return dot(minus(p[1], p[0]), cross(minus(p[2], p[0]), minus(p[3], p[0]))); };
    EXPECT_GT(turn(places) * turn(level), 0);
    EXPECT_LT(std::abs(turn(level)), 0.1 * std::abs(turn(places)));  // nearly level all the same
    EXPECT_TRUE(along_layers({{0, 0, 0}, turned(0, 0), {1, 1, 1}, nullptr, 0}, places).empty());
}

TEST(Lattice, StepsPartTheExtentEvenly) {
    const Lattice lattice = lattice_of(brep_of(box_of(turned(0.4, 0), {10, 20, 30}, {30, 20, 10})), 1.9);
    EXPECT_NEAR(lattice.steps[0] * 16, 30, 1e-9);
    EXPECT_NEAR(lattice.steps[1] * 11, 20, 1e-9);
    EXPECT_NEAR(lattice.steps[2] * 5, 10, 1e-9);
    const Vec3 p{12, 23, 31};
    const Vec3 back = lattice.place(lattice.coordinates(p));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], p[k], 1e-12);
}

TEST(Lattice, ABoxHasItsInnerPointsHoweverItIsTurned) {
    for (const double about_x : {0.0, 0.35}) {
        const Box box = box_of(turned(0.4, about_x), {512000, 6123000, -2000}, {30, 20, 10});
        const auto points = points_inside(facets_of(box), lattice_of(brep_of(box), 1));
        EXPECT_EQ(points.size(), 29u * 19u * 9u);
    }
}

TEST(Lattice, PointsKeepAwayFromASurfaceInside) {
    const Box box = box_of(turned(0, 0), {0, 0, 0}, {10, 10, 10});
    volumes::RegionFacets facets = facets_of(box);
    const auto first = static_cast<std::uint32_t>(facets.positions.size());
    for (const Vec3& p : {Vec3{0, 0, 5.3}, Vec3{10, 0, 5.3}, Vec3{10, 10, 5.3}, Vec3{0, 10, 5.3}}) facets.positions.push_back(p);
    for (const Triangle& t : {Triangle{first, first + 1, first + 2}, Triangle{first, first + 2, first + 3}}) {
        facets.triangles.push_back(t);
        facets.sides.push_back(volumes::on_both);
        facets.surfaces.push_back(1);
    }
    const auto points = points_inside(facets, lattice_of(brep_of(box), 1));
    EXPECT_EQ(points.size(), 81u * 8u);  // the level at 5 is left out
    EXPECT_TRUE(std::ranges::none_of(points, [](const Vec3& p) { return std::abs(p[2] - 5) < 0.5; }));
}

TEST(Lattice, ARegionBetweenABaseAndATopHasAsManyLayersInEachColumn) {
    Box box = box_of(turned(0, 0), {0, 0, 0}, {20, 10, 6});
    for (Vec3& p : box.places) p[2] += 0.4 * p[0] + (p[2] > 0 ? 0.1 * p[0] : 0);  // 6 high on one side, 8 on the other
    const BrepData brep = brep_of(box);
    Lattice common = lattice_of(brep, 1);
    common.axes = turned(0, 0);
    common.steps = {1, 1, 1};
    common.origin = {0, 0, 0};
    const Lattice own = lattice_of_region(facets_of(box), common);
    ASSERT_TRUE(own.layers);
    EXPECT_EQ(own.layers->count(), 7);
    const auto points = points_inside(facets_of(box), own);
    EXPECT_EQ(points.size(), 19u * 9u * 6u);
    for (const Vec3& p : points) {
        const double level = 7 * (p[2] - 0.4 * p[0]) / (6 + 0.1 * p[0]);
        EXPECT_NEAR(level, std::round(level), 1e-4);
        const Vec3 back = own.place(own.coordinates(p));
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], p[k], 1e-9);
    }
}

TEST(Lattice, AWedgeThatPinchesOutHasNoLayers) {
    Box box = box_of(turned(0, 0), {0, 0, 0}, {20, 10, 6});
    for (Vec3& p : box.places) p[2] *= p[0] > 0 ? 1 : 0.02;
    Lattice common{{0, 0, 0}, turned(0, 0), {1, 1, 1}, nullptr, 0};
    EXPECT_FALSE(lattice_of_region(facets_of(box), common).layers);
}

TEST(LatticeSampling, ALineIsCutWhereThePlanesAre) {
    Lattice lattice{{0, 0, 0}, turned(0, 0), {1, 1, 1}, nullptr, 0};
    remeshing::LineRules rules;
    rules.max_distance = 0.1;
    const std::vector<Vec3> straight{{0, 0, 0}, {0.3, 0, 0}, {4.7, 0, 0}, {10, 0, 0}};
    const auto samples = lattice_line(lattice, straight, rules);
    ASSERT_EQ(samples.size(), 11u);
    for (std::size_t i = 0; i < samples.size(); ++i)
        EXPECT_NEAR(remeshing::place_of(straight, samples[i])[0], static_cast<double>(i), 1e-12);

    // Ends off the planes: none of them nearer than half a step.
    const std::vector<Vec3> beside{{0.4, 0, 0}, {5.6, 0, 0}};
    std::vector<double> x;
    for (const auto& s : lattice_line(lattice, beside, rules)) x.push_back(remeshing::place_of(beside, s)[0]);
    EXPECT_EQ(x, (std::vector<double>{0.4, 1, 2, 3, 4, 5, 5.6}));
}

TEST(LatticeSampling, ABentLineKeepsWithinTheDistance) {
    const Lattice lattice{{0, 0, 0}, turned(0, 0), {1, 1, 1}, nullptr, 0};
    remeshing::LineRules rules;
    rules.max_distance = 0.05;
    std::vector<Vec3> arc;
    for (int i = 0; i <= 40; ++i) arc.push_back({2 * std::cos(i * std::numbers::pi / 40), 2 * std::sin(i * std::numbers::pi / 40), 0});
    const auto samples = lattice_line(lattice, arc, rules);
    for (std::size_t k = 1; k < samples.size(); ++k) {
        const Vec3 a = remeshing::place_of(arc, samples[k - 1]), b = remeshing::place_of(arc, samples[k]);
        const Vec3 middle = times(0.5, plus(a, b));
        EXPECT_GT(std::sqrt(dot(middle, middle)), 2 - 0.06);
    }
}

TEST(LatticeSampling, AFlatSheetHasTheLatticesPointsInsideOfItsBorders) {
    // Two triangles over 10 by 6 steps, seen along each axis.
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<Vec3> places;
        for (const auto& [a, b] : {std::pair(0.0, 0.0), std::pair(10.0, 0.0), std::pair(10.0, 6.0), std::pair(0.0, 6.0)}) {
            Vec3 p{};
            p[axis] = 2.3;
            p[(axis + 1) % 3] = a;
            p[(axis + 2) % 3] = b;
            places.push_back(p);
        }
        const auto mesh = remeshing::fanned_mesh(places, std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3},
                                                 std::vector<std::uint32_t>{no_index, no_index, 1, 0, no_index, no_index});
        ASSERT_TRUE(mesh);
        const Lattice lattice{{0, 0, 0}, turned(0, 0), {1, 1, 1}, nullptr, 0};
        EXPECT_EQ(lattice_surface(lattice, mesh->mesh, {}).size(), 9u * 5u);
        const std::vector<Vec3> taken{lattice_surface(lattice, mesh->mesh, {}).front().place};
        EXPECT_EQ(lattice_surface(lattice, mesh->mesh, taken).size(), 9u * 5u - 1);
    }
}

}  // namespace
}  // namespace geomend::hexes
