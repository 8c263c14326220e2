// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/lay_borders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "arrangement/arrange.h"

// Borders that end on surfaces, or run along other borders, within the tolerance and with vertices of their own.

namespace geomend {
namespace {

constexpr double tolerance = 0.1;

/// A sheet of n by m squares over a parallelogram, as a patch of a soup.
void add_sheet(TriangleSoup& soup, const Vec3& corner, const Vec3& u, const Vec3& v, int n, int m) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const std::uint32_t patch = soup.patches.empty() ? 0 : soup.patches.back() + 1;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= m; ++j) {
            Vec3 p = corner;
            for (std::size_t k = 0; k < 3; ++k) p[k] += u[k] * i / n + v[k] * j / m;
            soup.vertices.push_back(p);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const auto a = first + static_cast<std::uint32_t>(i * (m + 1) + j), b = a + static_cast<std::uint32_t>(m) + 1;
            soup.triangles.insert(soup.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
            soup.patches.insert(soup.patches.end(), {patch, patch});
        }
    }
}

arrangement::Arrangement laid_and_cut(const TriangleSoup& soup) {
    const auto laid = repair::lay_borders(soup, tolerance);
    EXPECT_TRUE(check(laid.soup).ok());
    EXPECT_TRUE(check(laid.origin, soup, laid.soup).ok());
    auto cut = arrangement::arrange(laid.soup, {.tolerance = tolerance});
    EXPECT_TRUE(cut.ok() && cut->clean);
    return std::move(*cut);
}

/// The length of the edges that triangles of both patches have, by the numbers of their vertices.
double shared_length(const TriangleSoup& soup) {
    std::map<std::array<std::uint32_t, 2>, unsigned> patches_of;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = soup.triangles[t][k], b = soup.triangles[t][(k + 1) % 3];
            patches_of[{std::min(a, b), std::max(a, b)}] |= 1u << soup.patches[t];
        }
    }
    double sum = 0;
    for (const auto& [edge, patches] : patches_of) {
        const Vec3 &a = soup.vertices[edge[0]], &b = soup.vertices[edge[1]];
        if (patches == 3) sum += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
    return sum;
}

TEST(LayBorders, ABorderThatHoversOverASurfaceEndsOnIt) {
    for (const double above : {0.09, 0.02, -0.09}) {
        TriangleSoup soup;
        add_sheet(soup, {0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 3, 4);
        add_sheet(soup, {2, 3.3, above}, {6, 1, 0}, {0, 0, 5}, 4, 2);
        const auto cut = laid_and_cut(soup);
        EXPECT_NEAR(shared_length(cut.soup), std::hypot(6, 1), 1e-3) << above;
        // The surface that it ends on stays in its plane.
        for (std::size_t t = 0; t < cut.soup.triangles.size(); ++t) {
            if (cut.soup.patches[t] != 0) continue;
            for (const std::uint32_t v : cut.soup.triangles[t]) EXPECT_NEAR(cut.soup.vertices[v][2], 0, 1e-3);
        }
        EXPECT_LE(cut.largest_move, tolerance);
    }
}

TEST(LayBorders, TwoBordersSideBySideBecomeOneLine) {
    TriangleSoup soup;
    add_sheet(soup, {0, 0, 0}, {10, 0, 0}, {0, -4, 0}, 5, 2);
    add_sheet(soup, {0, 0.08, 0.03}, {10, 0, 0}, {0, 4, 1}, 3, 2);
    EXPECT_NEAR(shared_length(laid_and_cut(soup).soup), 10, 0.1);
}

TEST(LayBorders, ASliverAtABorderGoes) {
    TriangleSoup soup;
    soup.vertices = {{0, 0, 0}, {10, 0, 0}, {5, 4, 0}, {5, 0.05, 0}};
    soup.triangles = {{0, 3, 2}, {0, 1, 3}, {3, 1, 2}};
    soup.patches = {0, 0, 0};
    const auto laid = repair::lay_borders(soup, tolerance);
    EXPECT_EQ(laid.dropped, 1u);
    ASSERT_EQ(laid.soup.triangles.size(), 2u);
    EXPECT_EQ(laid.soup.triangles[0], soup.triangles[0]);
    EXPECT_EQ(laid.soup.triangles[1], soup.triangles[2]);
    EXPECT_EQ(laid.origin.triangles, (std::vector<std::uint32_t>{0, 2}));
}

TEST(LayBorders, WhatIsFartherThanTheToleranceStaysToTheBit) {
    TriangleSoup soup;
    add_sheet(soup, {0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 3, 4);
    add_sheet(soup, {2, 3.3, 0.11}, {6, 1, 0}, {0, 0, 5}, 4, 2);
    const auto laid = repair::lay_borders(soup, tolerance);
    EXPECT_EQ(laid.soup.vertices, soup.vertices);
    EXPECT_EQ(laid.soup.triangles, soup.triangles);
    EXPECT_EQ(laid.moved + laid.made + laid.dropped, 0u);
}

}  // namespace
}  // namespace geomend
