// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/pattern.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "base/vectors.h"
#include "made_surfaces.h"

// A surface that gets the vertices of a pattern has them, and no others inside.

namespace geomend::remeshing {
namespace {

using test::numbers_of;

/// The points of a sheet of nx by ny squares over whole and half coordinates with an offset.
Pattern shifted_pattern(double shift, double step) {
    Pattern pattern;
    pattern.on_surface = [=](std::uint32_t, const EdgeMesh& surface, std::span<const Vec3>) {
        std::vector<SurfacePoint> points;
        for (std::uint32_t t = 0; t < surface.triangle_count(); ++t) {
            const auto p = surface.triangle(t);
            for (double x = shift; x < 14; x += step) {
                for (double y = shift; y < 11; y += step) {
                    const double whole = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
                    const double second = ((x - p[0][0]) * (p[2][1] - p[0][1]) - (y - p[0][1]) * (p[2][0] - p[0][0])) / whole;
                    const double third = ((p[1][0] - p[0][0]) * (y - p[0][1]) - (p[1][1] - p[0][1]) * (x - p[0][0])) / whole;
                    if (second <= 0 || third < 0 || second + third >= 1) continue;
                    points.push_back(point_at(surface, t, {1 - second - third, second, third}));
                }
            }
        }
        return points;
    };
    return pattern;
}

RC_GTEST_PROP(Pattern, ASheetHasThePointsAndNoOthersInside, ()) {
    const double wave = *rc::gen::inRange(0, 150) / 100.0, length = *rc::gen::inRange(4, 12);
    const EdgeMesh reference = test::sheet(14, 11, [&](double x, double y) { return wave * std::sin(x / length) * std::cos(y / length); });
    const std::vector<double> sizes(reference.places.size(), 1.0);
    const Pattern pattern = shifted_pattern(0.37, *rc::gen::element(0.8, 1.0, 1.7));
    std::set<Vec3> wanted;
    for (const SurfacePoint& p : pattern.on_surface(0, reference, {})) wanted.insert(p.place);
    WorkSurface work = work_surface(reference, {sizes, {}, 0});
    for (VertexKind& kind : work.kinds) kind = kind == VertexKind::old ? VertexKind::fixed : kind;
    const auto before = numbers_of(reference);
    remesh_to_pattern(work, pattern, 0, 1.0);
    RC_ASSERT(is_consistent(work.mesh));
    const auto after = numbers_of(work.mesh);
    RC_ASSERT(after.euler == before.euler);
    RC_ASSERT(after.border_edges == before.border_edges);
    std::set<Vec3> inside;
    for (std::uint32_t v = 0; v < work.mesh.places.size(); ++v) {
        if (work.mesh.has_vertex(v) && !work.mesh.on_border(v)) inside.insert(work.mesh.places[v]);
    }
    RC_ASSERT(inside == wanted);
}

TEST(Pattern, VerticesStayWhereSizesAreLower) {
    const EdgeMesh reference = test::sheet(14, 11);
    std::vector<double> sizes(reference.places.size(), 1.0);
    std::uint32_t lowered = 0;
    for (std::uint32_t v = 0; v < sizes.size(); ++v) {
        if (!reference.on_border(v) && reference.places[v] == Vec3{5, 5, 0}) sizes[lowered = v] = 0.5;
    }
    WorkSurface work = work_surface(reference, {sizes, {}, 0});
    for (VertexKind& kind : work.kinds) kind = kind == VertexKind::old ? VertexKind::fixed : kind;
    remesh_to_pattern(work, shifted_pattern(0.37, 1.7), 0, 1.0);
    ASSERT_NE(lowered, 0u);
    EXPECT_TRUE(work.mesh.has_vertex(lowered));
    EXPECT_EQ(work.mesh.places[lowered], (Vec3{5, 5, 0}));
}

/// The corner of a sheet of squares of one that is elsewhere: each square is a parallelogram there.
EdgeMesh leaning_sheet(double height, double lean) {
    EdgeMesh mesh = test::sheet(8, 4);
    for (Vec3& p : mesh.places) p = {p[0] + lean * p[1], height * p[1], 0};
    return mesh;
}

TEST(Pattern, EdgesAreThoseOfSquaresWhereItIsMadeOfThem) {
    const double height = 0.3, lean = 2;
    const EdgeMesh reference = leaning_sheet(height, lean);
    const std::vector<double> sizes(reference.places.size(), 1.0);
    Pattern pattern;
    pattern.on_surface = [](std::uint32_t, const EdgeMesh& surface, std::span<const Vec3>) {
        std::vector<SurfacePoint> all;
        for (std::uint32_t h = 0; h < surface.corners.size(); ++h) {
            if (surface.on_border(surface.corners[h])) continue;
            Weights weights{};
            weights[h % 3] = 1;
            all.push_back(point_at(surface, h / 3, weights));
        }
        return all;
    };
    const auto straight = [&](const Vec3& p) { return Vec3{p[0] - lean * p[1] / height, p[1] / height, 0}; };
    const auto edges_of_squares = [&](bool straightens) {
        WorkSurface work = work_surface(reference, {sizes, {}, 0});
        for (VertexKind& kind : work.kinds) kind = kind == VertexKind::old ? VertexKind::fixed : kind;
        if (straightens) {
            pattern.straightened = [&](std::uint32_t, std::span<const Vec3> places) {
                std::vector<Vec3> all;
                for (const Vec3& p : places) all.push_back(straight(p));
                return all;
            };
        }
        remesh_to_pattern(work, pattern, 0, 1.0);
        EXPECT_TRUE(is_consistent(work.mesh));
        std::size_t count = 0;
        for (std::uint32_t h = 0; h < work.mesh.corners.size(); ++h) {
            if (work.mesh.corners[h] == no_index) continue;
            const Vec3 d = minus(straight(work.mesh.places[work.mesh.to(h)]), straight(work.mesh.places[work.mesh.from(h)]));
            if (dot(d, d) < 1.1) ++count;
        }
        return count;
    };
    const std::size_t wanted = 2 * (8 * 5 + 4 * 9) - 24;  // each side of a square from both sides, but for the border
    EXPECT_LT(edges_of_squares(false), wanted);
    EXPECT_EQ(edges_of_squares(true), wanted);
}

}  // namespace
}  // namespace geomend::remeshing
