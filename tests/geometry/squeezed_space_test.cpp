// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/squeezed_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "geometry/triangle_tree.h"

namespace geomend {
namespace {

struct Soup {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    /// A cube of width 1 with random small triangles.
    void add_cloud(const Vec3& corner, unsigned seed, int count = 200) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> in_cube(0, 1), small(-0.05, 0.05);
        for (int i = 0; i < count; ++i) {
            const Vec3 p{corner[0] + in_cube(random), corner[1] + in_cube(random), corner[2] + in_cube(random)};
            const auto first = static_cast<std::uint32_t>(vertices.size());
            for (int k = 0; k < 3; ++k) vertices.push_back({p[0] + small(random), p[1] + small(random), p[2] + small(random)});
            triangles.push_back({first, first + 1, first + 2});
        }
    }
    std::array<Vec3, 2> extent() const {
        Vec3 low = vertices[0], high = vertices[0];
        for (const Vec3& p : vertices) {
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        return {low, high};
    }
    SqueezedSpace space() const { return SqueezedSpace(vertices, triangles, extent()[0], extent()[1]); }
};

Soup clouds_far_apart(double apart) {
    Soup soup;
    soup.add_cloud({0, 0, 0}, 1);
    soup.add_cloud({apart, 0, 0}, 2);
    soup.add_cloud({apart + 2, -3 * apart, 0}, 3);
    return soup;
}

TEST(SqueezedSpace, IsSpaceItselfWhereNothingIsEmpty) {
    Soup soup;
    soup.add_cloud({5, 6, 7}, 1);
    const auto space = soup.space();
    for (const double x : {-1e9, 5.0, 5.3, 7.0, 1e9}) EXPECT_EQ(space.at(0, x), x);
}

TEST(SqueezedSpace, IsSpaceItselfAlongAxesWhoseExtentIsNoNumber) {
    for (const double far : {1.6e308, std::numeric_limits<double>::infinity()}) {
        Soup soup = clouds_far_apart(100);
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        soup.vertices.insert(soup.vertices.end(), {{-far, 0, 0}, {far, 0, 0}, {0, 1, 0}});
        soup.triangles.push_back({first, first + 1, first + 2});
        const auto space = soup.space();
        for (const double x : {-1e9, 5.0, 1e9, 1.7e308}) EXPECT_EQ(space.at(0, x), x) << far;
        EXPECT_LT(space.at(1, 1) - space.at(1, -301), 302) << "the others are squeezed all the same";
    }
}

TEST(SqueezedSpace, KeepsTheOrderAndLengthensNothing) {
    std::mt19937 random(4);
    for (const double apart : {3.0, 100.0, 1e5, 1e9}) {
        const Soup soup = clouds_far_apart(apart);
        const auto space = soup.space();
        std::vector<double> xs{-apart, apart / 2, 2 * apart};
        for (const Vec3& p : soup.vertices) xs.push_back(p[0]);
        std::uniform_real_distribution<double> anywhere(-0.1 * apart, 1.2 * apart);
        for (int i = 0; i < 2000; ++i) xs.push_back(anywhere(random));
        std::ranges::sort(xs);
        for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
            const double step = space.at(0, xs[i + 1]) - space.at(0, xs[i]);
            EXPECT_GE(step, 0) << apart;
            EXPECT_LE(step, (xs[i + 1] - xs[i]) + 1e-15 * apart) << apart;
        }
        const auto [low, high] = soup.extent();
        EXPECT_LT(space.at(0, high[0]) - space.at(0, low[0]), 8) << apart;
    }
}

TEST(SqueezedSpace, KeepsDistancesWithinAPart) {
    const Soup soup = clouds_far_apart(1e6);
    const auto space = soup.space();
    for (std::size_t i = 0; i + 1 < 600; ++i) {
        const double x = soup.vertices[i][0], y = soup.vertices[i + 1][0];
        EXPECT_NEAR(std::abs(space.at(0, x) - space.at(0, y)), std::abs(x - y), 1e-9);
    }
}

TEST(TriangleTree, FindsTheSamePairsWhereverPartsLie) {
    Soup near;
    near.add_cloud({0, 0, 0}, 1);
    const auto pairs_of = [](const Soup& soup) {
        const TriangleTree tree(soup.vertices, soup.triangles);
        std::size_t pairs = 0;
        tree.visit_pairs(tree.levels().size() - 1, 0, 0,
                         [&](std::size_t, std::size_t, unsigned hits) { visit_bits(hits, [&](std::size_t) { ++pairs; }); });
        return pairs;
    };
    const std::size_t one = pairs_of(near);
    for (const double apart : {10.0, 1e4, 1e8}) {
        Soup soup = near;
        for (std::size_t t = 0; t < near.triangles.size(); ++t) {
            const auto first = static_cast<std::uint32_t>(soup.vertices.size());
            for (std::uint32_t k = 0; k < 3; ++k) {
                Vec3 p = near.vertices[near.triangles[t][k]];
                p[0] += apart;
                soup.vertices.push_back(p);
            }
            soup.triangles.push_back({first, first + 1, first + 2});
        }
        EXPECT_NEAR(static_cast<double>(pairs_of(soup)), 2.0 * static_cast<double>(one), 4) << apart;
    }
}

// Boxes are in single precision, the numbers of files are not.
TEST(TriangleTree, VisitsTrianglesThatAreThereAndNoOther) {
    for (const double far : {1e3, 1e39, 1e300, 1.6e308}) {
        for (std::size_t count = 1; count < 10; ++count) {
            Soup soup;
            for (std::size_t i = 0; i < count; ++i) {
                const double x = i % 2 == 0 ? far : -far;
                const auto first = static_cast<std::uint32_t>(soup.vertices.size());
                soup.vertices.insert(soup.vertices.end(), {{x, static_cast<double>(i), 0}, {0, x, 0}, {0, 0, 1}});
                soup.triangles.push_back({first, first + 1, first + 2});
            }
            const TriangleTree tree(soup.vertices, soup.triangles);
            std::vector<std::size_t> seen, all(tree.size());
            std::iota(all.begin(), all.end(), std::size_t{0});
            const auto see = [&](std::size_t i) { seen.push_back(i); };
            const Box around = tree.box(soup.extent()[0], soup.extent()[1], 1);
            tree.visit_triangles(around, see);
            EXPECT_EQ(seen, all) << far;
            seen.clear();
            tree.visit_triangles(tree.widened(around, far), see);
            EXPECT_EQ(seen, all) << far;
        }
    }
}

}  // namespace
}  // namespace geomend
