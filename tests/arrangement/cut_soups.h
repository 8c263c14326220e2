// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "arrangement/arrange.h"
#include "arrangement/sheets.h"
#include "geometry/intersections.h"
#include "geometry/vectors.h"

namespace geomend::test {

using arrangement::Arrangement;

inline void add_patch(TriangleSoup& soup, std::vector<Vec3> points, const std::vector<Triangle>& triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const std::uint32_t patch = soup.patches.empty() ? 0 : soup.patches.back() + 1;
    soup.vertices.insert(soup.vertices.end(), points.begin(), points.end());
    for (const auto& [a, b, c] : triangles) {
        soup.triangles.push_back({first + a, first + b, first + c});
        soup.patches.push_back(patch);
    }
}

inline double area_of(const TriangleSoup& soup) {
    double sum = 0;
    for (const auto& [a, b, c] : soup.triangles) {
        const Vec3 n = cross(minus(soup.vertices[b], soup.vertices[a]), minus(soup.vertices[c], soup.vertices[a]));
        sum += 0.5 * std::sqrt(dot(n, n));
    }
    return sum;
}

/// Twice the largest distance of a used vertex from their middle: as lengths are told elsewhere, near enough.
inline double extent_of(const TriangleSoup& soup) {
    Vec3 low = soup.vertices[0], high = low;
    for (const Vec3& p : soup.vertices) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    const Vec3 d = minus(high, low);
    return std::sqrt(dot(d, d));
}

/// The triangles of each vertex triple once: what lies on each other over the same vertices meets in nothing else.
inline std::vector<Triangle> distinct(const TriangleSoup& soup) {
    std::set<std::array<std::uint32_t, 3>> seen;
    std::vector<Triangle> kept;
    for (const Triangle& t : soup.triangles) {
        auto sorted = t;
        std::sort(sorted.begin(), sorted.end());
        if (seen.insert(sorted).second) kept.push_back(t);
    }
    return kept;
}

/// Pairs of triangles of the result that meet in more than they share by number, by the exact test, in doubles as they are.
inline std::size_t bad_pairs(const TriangleSoup& soup) {
    const auto triangles = distinct(soup);
    const auto pairs = intersections(soup.vertices, triangles);
    for (std::size_t i = 0; i < std::min<std::size_t>(pairs.size(), 3); ++i) {
        for (const std::uint32_t t : {pairs[i].a, pairs[i].b}) {
            for (const std::uint32_t v : triangles[t])
                ADD_FAILURE() << t << ": " << v << " at " << testing::PrintToString(soup.vertices[v]);
        }
    }
    return pairs.size();
}

/// The smallest distance between two vertices that triangles use, by sorting along one axis; up to `most` is told.
inline double closest_vertices(const TriangleSoup& soup, double most) {
    std::vector<Vec3> points;
    std::vector<std::uint8_t> used(soup.vertices.size(), 0);
    for (const Triangle& t : soup.triangles) {
        for (const std::uint32_t v : t) used[v] = 1;
    }
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (used[v] != 0) points.push_back(soup.vertices[v]);
    }
    std::sort(points.begin(), points.end());
    double least = most;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size() && points[j][0] - points[i][0] < least; ++j) {
            const Vec3 d = minus(points[j], points[i]);
            least = std::min(least, std::sqrt(dot(d, d)));
        }
    }
    return least;
}

/// What every cut must hold, judged from outside.
inline void expect_cut(const TriangleSoup& soup, const Arrangement& cut, double tolerance) {
    EXPECT_TRUE(cut.clean) << cut.rounds << " rounds";
    EXPECT_TRUE(check(cut.soup).ok());
    const auto sound = check(cut.origin, soup, cut.soup);
    EXPECT_TRUE(sound.ok()) << (sound.ok() ? "" : sound.why().error.message);
    EXPECT_EQ(bad_pairs(cut.soup), 0u);
    EXPECT_GE(closest_vertices(cut.soup, 2 * tolerance), tolerance * (1 - 1e-2));
    for (std::size_t t = 0; t < cut.soup.triangles.size(); ++t) EXPECT_EQ(cut.soup.patches[t], soup.patches[cut.origin.triangles[t]]);
}

inline Arrangement expect_arranged(const TriangleSoup& soup, double tolerance) {
    auto cut = arrangement::arrange(soup, {.tolerance = tolerance});
    EXPECT_TRUE(cut.ok());
    expect_cut(soup, *cut, tolerance);
    const auto again = arrangement::arrange(cut->soup, {.tolerance = tolerance});
    EXPECT_TRUE(again.ok());
    EXPECT_EQ(again->soup.triangles, cut->soup.triangles) << "a second cut changes nothing";
    EXPECT_EQ(again->soup.vertices, cut->soup.vertices);
    return std::move(*cut);
}

}  // namespace geomend::test
