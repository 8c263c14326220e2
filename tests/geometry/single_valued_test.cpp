// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/single_valued.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "geometry/intersections.h"
#include "soups.h"

namespace geomend {
namespace {

using test::Soup;
using Edge = std::array<std::uint32_t, 2>;

/// Directed edges whose opposite no triangle has, or that are there more than once.
std::vector<Edge> open_edges(const Soup& soup) {
    std::map<Edge, int> uses;
    for (const Triangle& t : soup.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
    }
    std::vector<Edge> open;
    for (const auto& [edge, count] : uses) {
        const auto opposite = uses.find({edge[1], edge[0]});
        if (count == 1 && opposite != uses.end() && opposite->second == 1) continue;
        for (int i = 0; i < count; ++i) open.push_back(edge);
    }
    return open;
}

bool is_single_valued(const Soup& soup) { return geomend::is_single_valued(soup.vertices, soup.triangles, open_edges(soup)); }

/// A sheet of 2 n m triangles whose node (i, j) lies at place(i, j); `wanted` says which squares are there.
template <class Place, class Wanted>
Soup sheet(std::uint32_t n, std::uint32_t m, const Place& place, const Wanted& wanted) {
    Soup soup;
    for (std::uint32_t j = 0; j <= m; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) soup.vertices.push_back(place(i, j));
    }
    for (std::uint32_t j = 0; j < m; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            if (!wanted(i, j)) continue;
            const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            soup.triangles.push_back({a, b, c});
            soup.triangles.push_back({a, c, d});
        }
    }
    return soup;
}

bool all(std::uint32_t, std::uint32_t) { return true; }
Vec3 wavy(double x, double y) { return {x, y, std::sin(x) + 0.3 * std::cos(2 * y)}; }

Soup together(Soup a, const Soup& b) {
    const auto shift = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return a;
}

TEST(SingleValued, ProvesASheetOverAPlaneAlongAnyAxisWhicheverWayItFaces) {
    for (unsigned turn = 0; turn < 3; ++turn) {
        Soup soup = sheet(9, 7, wavy, all);
        for (Vec3& p : soup.vertices) p = {p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]};
        EXPECT_TRUE(is_single_valued(soup)) << turn;
        for (Triangle& t : soup.triangles) std::swap(t[0], t[1]);
        EXPECT_TRUE(is_single_valued(soup)) << turn;
    }
}

TEST(SingleValued, ProvesASheetWithHolesAndOneInPiecesSideBySide) {
    EXPECT_TRUE(is_single_valued(sheet(9, 7, wavy, [](auto i, auto j) { return i % 3 != 1 || j % 3 != 1; })));
    EXPECT_TRUE(is_single_valued(sheet(9, 7, wavy, [](auto i, auto) { return i != 4; })));
}

TEST(SingleValued, SaysNothingOfSheetsAboveEachOther) {
    const Soup low = sheet(9, 7, wavy, all);
    Soup high = sheet(
        3, 2,
        [](double x, double y) {
            return Vec3{x + 2.5, y + 2.5, 9};
        },
        all);
    EXPECT_FALSE(is_single_valued(together(low, high)));
    for (Vec3& p : high.vertices) p[2] = 0;  // through the waves
    EXPECT_FALSE(is_single_valued(together(low, high)));
}

TEST(SingleValued, SaysNothingOfASpiralStairThatCoversThePlaneTwice) {
    const auto stair = [](double i, double j) {
        const double angle = i * std::numbers::pi / 8, r = 1 + j;
        return Vec3{r * std::cos(angle), r * std::sin(angle), i};
    };
    EXPECT_TRUE(is_single_valued(sheet(14, 3, stair, all)));
    EXPECT_FALSE(is_single_valued(sheet(31, 3, stair, all)));
    EXPECT_FALSE(is_single_valued(sheet(18, 3, stair, all)));
}

TEST(SingleValued, SaysNothingOfAClosedSurfaceOrATube) {
    const auto tube = [](std::uint32_t i, std::uint32_t j) {
        const double angle = i * std::numbers::pi / 4;
        return Vec3{std::cos(angle), std::sin(angle), double(j)};
    };
    EXPECT_FALSE(is_single_valued(sheet(8, 3, tube, all)));
    Soup tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}, {}};
    EXPECT_FALSE(is_single_valued(tetrahedron));
}

TEST(SingleValued, SaysNothingWhereBorderPointsLieAtOnePlaceButAreNotShared) {
    Soup left = sheet(2, 4, wavy, all);
    const Soup right = sheet(
        2, 4, [](double x, double y) { return wavy(x + 2, y); }, all);
    EXPECT_FALSE(is_single_valued(together(left, right)));
}

TEST(SingleValued, SaysNothingWhereTwoTrianglesHaveTheirEdgeInOneDirection) {
    Soup fold{{{0, 0, 0}, {1, 0, 0}, {0.4, 1, 0}, {0.6, 1, 0.5}}, {{0, 1, 2}, {0, 1, 3}}, {}};
    EXPECT_FALSE(is_single_valued(fold));
}

RC_GTEST_PROP(SingleValued, WhatItProvesHasNoPairThatMeets, ()) {
    const auto size = *rc::gen::inRange<std::uint32_t>(2, 9);
    const double rough = 0.1 * *rc::gen::inRange(0, 12);
    const auto missing = *rc::gen::container<std::set<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, size * size));
    const auto moves = *rc::gen::container<std::vector<int>>(3 * (size + 1) * (size + 1), rc::gen::inRange(-10, 11));
    std::size_t at = 0;
    const auto place = [&](double x, double y) {
        const double dx = 0.1 * rough * moves[at++], dy = 0.1 * rough * moves[at++], dz = 0.1 * rough * moves[at++];
        return Vec3{x + dx, y + dy, dz};
    };
    const Soup soup = sheet(size, size, place, [&](auto i, auto j) { return !missing.contains(j * size + i); });
    const bool is_proven = is_single_valued(soup);
    RC_CLASSIFY(is_proven, "proven");
    if (is_proven) RC_ASSERT(intersections(soup.vertices, soup.triangles).empty());
    if (rough == 0 && missing.empty()) RC_ASSERT(is_proven);
}

RC_GTEST_PROP(SingleValued, WhatItProvesOfSheetsThatWindAnywhereHasNoPairThatMeets, ()) {
    const auto count = *rc::gen::inRange<std::uint32_t>(2, 40);
    const auto steps = *rc::gen::container<std::vector<int>>(count + 1, rc::gen::inRange(-6, 7));
    std::vector<Vec3> inner, outer;
    double angle = 0, x = 0, y = 0;
    for (std::uint32_t i = 0; i <= count; ++i) {
        angle += 0.12 * steps[i];
        inner.push_back({x - std::sin(angle) * 0.4, y + std::cos(angle) * 0.4, 0.01 * i * (steps[0] % 2)});
        outer.push_back({x + std::sin(angle) * 0.4, y - std::cos(angle) * 0.4, 0.01 * i * (steps[0] % 2)});
        x += std::cos(angle);
        y += std::sin(angle);
    }
    const Soup soup = sheet(
        count, 1, [&](auto i, auto j) { return j == 0 ? outer[i] : inner[i]; }, all);
    const bool is_proven = is_single_valued(soup);
    RC_CLASSIFY(is_proven, "proven");
    if (is_proven) RC_ASSERT(intersections(soup.vertices, soup.triangles).empty());
}

}  // namespace
}  // namespace geomend
