// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/isotropic.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "made_surfaces.h"
#include "remesh/crossings.h"
#include "remesh/polish.h"
#include "remesh/sample_line.h"
#include "remesh/size_rules.h"
#include "remesh/triangle_quality.h"

// What remeshing must not do to a surface, whatever its shape and size.

namespace geomend::remeshing {
namespace {

using test::numbers_of;
using test::quality_of;
using test::with_fixed_borders;

/// The places of the vertices on borders.
std::set<Vec3> border_places(const EdgeMesh& mesh) {
    std::set<Vec3> places;
    for (std::uint32_t v = 0; v < mesh.places.size(); ++v) {
        if (mesh.has_vertex(v) && mesh.on_border(v)) places.insert(mesh.places[v]);
    }
    return places;
}

RC_GTEST_PROP(Isotropic, TopologyAndBordersStayAndVerticesLieOnTheSurface, ()) {
    const double wave = *rc::gen::inRange(0, 300) / 100.0, length = *rc::gen::inRange(2, 12), size = *rc::gen::inRange(20, 600) / 100.0;
    const EdgeMesh reference = test::sheet(14, 11, [&](double x, double y) { return wave * std::sin(x / length) * std::cos(y / length); });
    const std::vector<double> sizes(reference.places.size(), size);
    WorkSurface work = with_fixed_borders(reference, sizes);
    const auto before = numbers_of(reference);
    const auto border = border_places(reference);
    remesh_isotropic(work, {});
    RC_ASSERT(is_consistent(work.mesh));
    const auto after = numbers_of(work.mesh);
    RC_ASSERT(after.euler == before.euler);
    RC_ASSERT(after.border_edges == before.border_edges);
    RC_ASSERT(border_places(work.mesh) == border);
    for (std::uint32_t v = 0; v < work.mesh.places.size(); ++v) {
        if (work.mesh.has_vertex(v) && work.kinds[v] == VertexKind::inner)
            RC_ASSERT(closest_point(reference, work.mesh.places[v], work.triangles[v]).distance < 0.3 * size);
    }
}

TEST(Isotropic, AFlatSheetBecomesNearlyEquilateral) {
    const EdgeMesh reference = test::sheet(40, 30);
    const std::vector<double> sizes(reference.places.size(), 0.5);  // its borders have edges of 1: triangles grow towards them
    WorkSurface work = with_fixed_borders(reference, sizes);
    remesh_isotropic(work, {});
    const TriangleQuality quality = quality_of(work.mesh);
    EXPECT_GT(quality.mean_quality(), 0.85);
    EXPECT_GT(quality.share_above_30(), 0.97);
}

TEST(Isotropic, ALargeTriangleIsNotFilledWithTheSmallSizesOfItsCorners) {
    const EdgeMesh reference = test::sheet(1, 1);
    const std::vector<double> sizes(4, 0.01), most(4, 0.2);
    WorkSurface work = work_surface(reference, {sizes, most, 0.3, nullptr});
    for (VertexKind& kind : work.kinds) kind = VertexKind::fixed;
    remesh_isotropic(work, {});
    EXPECT_LT(numbers_of(work.mesh).triangles, 3000u);
    EXPECT_TRUE(is_consistent(work.mesh));
}

TEST(Isotropic, AClosedSurfaceWithoutLinesStaysClosed) {
    const EdgeMesh reference = test::closed_cube(6);
    for (const double size : {0.4, 2.0, 100.0}) {
        const std::vector<double> sizes(reference.places.size(), size);
        WorkSurface work = work_surface(reference, {sizes, {}, 0, nullptr});
        remesh_isotropic(work, {});
        EXPECT_TRUE(is_consistent(work.mesh));
        EXPECT_EQ(numbers_of(work.mesh).euler, 2) << size;
        EXPECT_EQ(numbers_of(work.mesh).border_edges, 0u) << size;
    }
}

TEST(Isotropic, EveryOldVertexOfAStraightBorderGivesWay) {
    const EdgeMesh reference = test::sheet(20, 20);
    const std::vector<double> sizes(reference.places.size(), 5);
    WorkSurface work = work_surface(reference, {sizes, {}, 0, nullptr});
    for (std::uint32_t v = 0; v < reference.places.size(); ++v) {
        const auto& p = reference.places[v];
        const auto stays = [](double x) { return std::fmod(x, 5.0) == 0; };
        if (reference.on_border(v) && stays(p[0]) && stays(p[1])) work.kinds[v] = VertexKind::fixed;
    }
    remesh_isotropic(work, {});
    EXPECT_EQ(numbers_of(work.mesh).border_edges, 16u);
    for (std::uint32_t v = 0; v < work.mesh.places.size(); ++v) EXPECT_FALSE(work.mesh.has_vertex(v) && work.kinds[v] == VertexKind::old);
}

/// A strip with a slit from the middle of it to its right end.
EdgeMesh slit_sheet() {
    std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}};
    return test::mesh_of(places, {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 8, 3, 8, 7, 4, 6, 9, 4, 9, 8});
}

TEST(ReferenceSurface, APointBeyondASlitIsFoundFromItsTip) {
    const EdgeMesh reference = slit_sheet();
    const Vec3 beyond{1.9, 1.5, 0}, tip{1, 1, 0};
    const std::uint32_t below = 3;  // the slit is one of its edges
    EXPECT_NEAR(closest_point(reference, beyond, below).distance, 0.5, 1e-12);
    EXPECT_NEAR(closest_point_around(reference, beyond, below, std::hypot(beyond[0] - tip[0], beyond[1] - tip[1])).distance, 0, 1e-12);
}

TEST(ReferenceSurface, ANeedleDoesNotStopTheWay) {
    // two large triangles with one between them whose middle vertex lies 1e-9 from its long edge, far from the origin
    const Vec3 far{1.6e6, -1.7e5, -9e3};
    std::vector<Vec3> places{{0, 0, 0}, {100, 0, 0}, {40, 1e-9, 0}, {50, -80, 0}, {20, 90, 0}};
    for (Vec3& p : places) {
        for (std::size_t k = 0; k < 3; ++k) p[k] += far[k];
    }
    const EdgeMesh reference = test::mesh_of(places, {0, 3, 1, 0, 1, 2, 0, 2, 4, 2, 1, 4});
    for (const double x : {10.0, 35.0, 41.0, 60.0}) {
        const SurfacePoint found = closest_point(reference, {far[0] + x, far[1] + 15, far[2]}, 0);
        EXPECT_LT(found.distance, 1e-6) << x;
    }
}

TEST(Crossings, AnEdgeOverARidgeIsMeasuredAtTheRidge) {
    const EdgeMesh roof = test::sheet(10, 10, [](double x, double) { return x < 3 ? x : 3 - (x - 3) * 3 / 7; });
    for (const Vec3& from : {Vec3{0, 5.3, 0}, Vec3{0, 5, 0}, Vec3{0, 2.25, 0}}) {  // inside of an edge, at a vertex, and near one
        const Vec3 to{10, from[1] + 0.5, 0};
        double highest = 0;
        SurfacePoint start;
        for (std::uint32_t t = 0; t < roof.triangle_count(); ++t) {
            const SurfacePoint at = closest_point(roof, from, t);
            if (t == 0 || at.distance < start.distance) start = at;
        }
        std::size_t count = 0;
        visit_crossings(roof, from, to, start, [&](const CrossingWalk& walk) {
            const double dx = walk.on_surface()[0] - walk.on_edge()[0], dz = walk.on_surface()[2] - walk.on_edge()[2];
            highest = std::max(highest, std::hypot(dx, dz));
            ++count;
        });
        EXPECT_NEAR(highest, 3, 0.01) << from[1];
        EXPECT_GE(count, 10u);
    }
}

TEST(SizeRules, ZonesAreAsWideAsTheThesisHasThem) {
    const auto zone = [](double from, double to) { return influence_zone(from, to, 0.8); };
    EXPECT_NEAR(zone(5, 50), 290.98, 0.01);
    EXPECT_NEAR(zone(50, 5), 178.53, 0.01);
    EXPECT_NEAR(zone(10, 75), 385.81, 0.01);
    EXPECT_NEAR(zone(75, 10), 259.73, 0.01);
    EXPECT_NEAR(zone(10, 50), 249.59, 0.01);
    EXPECT_EQ(zone(10, 10), 0);
    SizeRule rule;
    rule.size = 5;
    EXPECT_EQ(size_at_distance(rule, 0, 50), 5);
    EXPECT_NEAR(size_at_distance(rule, 290.98 / 2, 50), 27.5, 0.01);
    EXPECT_EQ(size_at_distance(rule, 291, 50), 50);
    rule.thickness = 100;
    EXPECT_EQ(size_at_distance(rule, 100, 50), 5);
    EXPECT_NEAR(size_at_distance(rule, 100 + 290.98 / 2, 50), 27.5, 0.01);
    rule.exponent = 2;
    EXPECT_NEAR(size_at_distance(rule, 100 + 290.98 / 2, 50), 5 + 45.0 / 4, 0.01);
}

TEST(Polish, SmallAnglesInsideBecomeLargerAndNothingElseChanges) {
    EdgeMesh reference = test::sheet(12, 12);
    WorkSurface work = with_fixed_borders(reference, std::vector<double>(reference.places.size(), 1));
    const std::vector<double> sizes(reference.places.size(), 1);
    work.reference_sizes = {sizes, {}, 0, nullptr};
    for (std::uint32_t v = 0; v < work.kinds.size(); ++v) {
        if (work.kinds[v] == VertexKind::inner && v % 3 == 0) work.mesh.places[v][0] += 0.85;  // near its neighbour
    }
    const auto border = border_places(work.mesh);
    const TriangleQuality before = quality_of(work.mesh);
    EXPECT_GT(polish_triangles(work, 34), 0u);
    const TriangleQuality after = quality_of(work.mesh);
    EXPECT_LT(before.least_angle, 10);
    EXPECT_GT(after.least_angle, 25);
    EXPECT_GT(after.share_above_30(), 0.98);
    EXPECT_TRUE(is_consistent(work.mesh));
    EXPECT_EQ(border_places(work.mesh), border);
    EXPECT_EQ(numbers_of(work.mesh).euler, 1);
}

TEST(SampleLine, AStraightLineIsPartedEvenly) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 100; ++i) points.push_back({double(i), 0, 0});
    const std::vector<double> sizes(points.size(), 30);
    LineRules rules;
    rules.max_distance = 1;
    const auto samples = sample_line(points, {sizes, {}, 0, nullptr}, rules);
    ASSERT_EQ(samples.size(), 4u);
    EXPECT_NEAR(place_of(points, samples[1])[0], 100.0 / 3, 1e-9);
    EXPECT_EQ(place_of(points, samples.back()), points.back());
}

TEST(SampleLine, SizesGrowBetweenPointsThatLieFarApart) {
    const std::vector<Vec3> points{{0, 0, 0}, {1000, 0, 0}};
    const std::vector<double> sizes{1, 1}, most{100, 100};
    LineRules rules;
    rules.max_distance = 1;
    const auto samples = sample_line(points, {sizes, most, 0.3, nullptr}, rules);
    EXPECT_LT(samples.size(), 50u);
    double longest = 0;
    for (std::size_t k = 1; k < samples.size(); ++k) {
        const double before = samples[k - 1].share * 1000, after = samples[k].segment == 1 ? 1000 : samples[k].share * 1000;
        longest = std::max(longest, after - before);
        EXPECT_LT(after - before, 2 + 0.5 * std::min(after, 1000 - before));
    }
    EXPECT_GT(longest, 60);
    EXPECT_LT(longest, 150);
}

TEST(SampleLine, SharpBendsStay) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 37; ++i) points.push_back({double(i), 0, 0});
    for (int i = 1; i <= 41; ++i) points.push_back({37, double(i), 0});
    const std::vector<double> sizes(points.size(), 10);
    LineRules rules;
    rules.max_distance = 1;
    bool found = false;
    for (const LineSample& s : sample_line(points, {sizes, {}, 0, nullptr}, rules)) found = found || place_of(points, s) == Vec3{37, 0, 0};
    EXPECT_TRUE(found);
}

RC_GTEST_PROP(SampleLine, NoPointIsFartherThanAllowed, ()) {
    const auto heights = *rc::gen::container<std::vector<int>>(30, rc::gen::inRange(-50, 50));
    const double size = *rc::gen::inRange(1, 40), allowed = *rc::gen::inRange(1, 100) / 10.0;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < heights.size(); ++i) points.push_back({double(i), heights[i] / 10.0, 0});
    const std::vector<double> sizes(points.size(), size);
    LineRules rules;
    rules.max_distance = allowed;
    const auto samples = sample_line(points, {sizes, {}, 0, nullptr}, rules);
    RC_ASSERT(samples.front() == LineSample{});
    RC_ASSERT(place_of(points, samples.back()) == points.back());
    for (const Vec3& p : points) {
        double least = 1e300;
        for (std::size_t k = 1; k < samples.size(); ++k) {
            const Vec3 a = place_of(points, samples[k - 1]), b = place_of(points, samples[k]);
            const double dx = b[0] - a[0], dy = b[1] - a[1], whole = dx * dx + dy * dy;
            const double t = std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / whole, 0.0, 1.0);
            least = std::min(least, std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy));
        }
        RC_ASSERT(least <= allowed * (1 + 1e-9));
    }
}

}  // namespace
}  // namespace geomend::remeshing
