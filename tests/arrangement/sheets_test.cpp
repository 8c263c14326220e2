// SPDX-License-Identifier: AGPL-3.0-or-later
// Triangles that lie upon each other, within some tolerances, so that they are cut as one sheet or not at all.
#include "arrangement/sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "arrangement/planar_cut.h"
#include "arrangement/soup_kinds.h"
#include "arrangement/soup_of.h"
#include "cut_soups.h"

namespace geomend::test {
namespace {

using arrangement::cut_in_plane;
using arrangement::SpacedPoints;

double area_in_plane(const std::vector<Vec3>& points, const Triangle& t) {
    const Vec3 n = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
    return 0.5 * n[2];
}

/// Points of a grid of steps that keep one step from each other.
SpacedPoints points_at(const std::vector<Vec3>& places) {
    SpacedPoints points(1, places.size());
    for (const Vec3& p : places) points.add(p);
    return points;
}

/// Per triangle that was cut the area of what it covers.
std::map<std::uint32_t, double> covered(const std::vector<Vec3>& points, const arrangement::PlanarCut& cut) {
    std::map<std::uint32_t, double> areas;
    for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
        for (std::uint32_t c = cut.first[t]; c < cut.first[t + 1]; ++c)
            areas[cut.covers[c].whole] += (cut.covers[c].turned ? -1 : 1) * area_in_plane(points, cut.triangles[t]);
    }
    return areas;
}

constexpr Vec3 up{0, 0, 1};

// The second one is turned over and sticks out of the first one on two sides.
TEST(PlanarCut, GivesEachTriangleItsOwnAreaAndItsOwnSide) {
    SpacedPoints points = points_at({{0, 0, 0}, {1200, 0, 0}, {0, 1200, 0}, {300, -300, 0}, {300, 1200, 0}, {900, 300, 0}});
    const std::vector<Triangle> wholes{{0, 1, 2}, {3, 4, 5}};
    const auto cut = cut_in_plane(points, wholes, up, 1.0 / 32);
    ASSERT_TRUE(cut);
    const auto areas = covered(points.points(), *cut);
    ASSERT_EQ(areas.size(), 2u);
    EXPECT_NEAR(areas.at(0), area_in_plane(points.points(), wholes[0]), 1e-6);
    EXPECT_NEAR(areas.at(1), area_in_plane(points.points(), wholes[1]), 1e-6);
    std::size_t both = 0;
    for (std::size_t t = 0; t < cut->triangles.size(); ++t) {
        EXPECT_GT(area_in_plane(points.points(), cut->triangles[t]), 0) << "all turn the same way";
        both += cut->first[t + 1] - cut->first[t] == 2 ? 1 : 0;
    }
    EXPECT_GT(both, 0u);
}

// What neither covers is no triangle of the result: two that only touch in a corner, and the notch between two that share an edge.
TEST(PlanarCut, HasNothingBesideTheTriangles) {
    SpacedPoints points = points_at({{0, 0, 0}, {1000, 0, 0}, {500, 400, 0}, {0, 900, 0}, {-700, -100, 0}});
    const std::vector<Triangle> wholes{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    const auto cut = cut_in_plane(points, wholes, up, 1.0 / 32);
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->triangles.size(), 3u) << "nothing crosses";
    for (std::size_t t = 0; t < 3; ++t) EXPECT_EQ(cut->first[t + 1] - cut->first[t], 1u);
}

Vec3 normal_of(const TriangleSoup& s, const Triangle& t) {
    return cross(minus(s.vertices[t[1]], s.vertices[t[0]]), minus(s.vertices[t[2]], s.vertices[t[0]]));
}

/// Over the longest side.
double height_of(const TriangleSoup& s, const Triangle& t) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 d = minus(s.vertices[t[(i + 1) % 3]], s.vertices[t[i]]);
        longest = std::max(longest, std::sqrt(dot(d, d)));
    }
    const Vec3 n = normal_of(s, t);
    return std::sqrt(dot(n, n)) / longest;
}

// Planes that are next to parallel have no end of points in common that are near each other. What comes of it is as clean as any cut:
// pieces keep the side of what they are pieces of, vertices go hardly farther than the thickest sheet, and a second cut finds nothing.
TEST(Sheets, WhatCannotBeCutOtherwiseIsCutAsOneSheet) {
    unsigned laid = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        const auto [soup, tolerance] = random_soup("nearly_coplanar", seed);
        const auto cut = arrangement::arrange(soup, {.tolerance = tolerance});
        ASSERT_TRUE(cut.ok());
        if (cut->laid == 0) continue;
        SCOPED_TRACE(seed);
        ++laid;
        expect_cut(soup, *cut, tolerance);
        EXPECT_LE(cut->largest_move, 48 * tolerance) << "half as thick again as the thickest: points are put together, too";
        for (std::size_t t = 0; t < cut->soup.triangles.size(); ++t) {
            const Triangle &piece = cut->soup.triangles[t], &whole = soup.triangles[cut->origin.triangles[t]];
            if (height_of(soup, whole) < 100 * tolerance) continue;  // it may be turned by what points may move
            EXPECT_GT(dot(normal_of(cut->soup, piece), normal_of(soup, whole)), 0) << "piece " << t;
        }
        const auto again = arrangement::arrange(cut->soup, {.tolerance = tolerance});
        EXPECT_EQ(again->laid, 0u);
        EXPECT_EQ(again->soup.triangles, cut->soup.triangles);
        EXPECT_EQ(again->soup.vertices, cut->soup.vertices);
    }
    EXPECT_GT(laid, 0u);
}

}  // namespace
}  // namespace geomend::test
