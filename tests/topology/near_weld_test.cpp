// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/near_weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <random>

#include "base/disjoint_sets.h"
#include "geometry/vectors.h"

namespace geomend::topology {
namespace {

std::vector<std::uint32_t> clusters_of_all_pairs(const std::vector<Vec3>& positions, double tolerance) {
    DisjointSets sets(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            const Vec3 d = minus(positions[i], positions[j]);
            if (dot(d, d) <= tolerance * tolerance) sets.join(i, j);
        }
    }
    return std::move(sets).roots();
}

std::vector<Vec3> cloud(std::mt19937& random, std::size_t count, double size, const Vec3& origin = {}) {
    std::uniform_real_distribution<double> place(0, size);
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(plus(origin, {place(random), place(random), place(random)}));
    return all;
}

TEST(NearWeld, JoinsWhatAChainOfNearPairsLinks) {
    std::mt19937 random(1);
    for (const double size : {0.5, 2.0, 5.0, 20.0, 100.0}) {
        for (const Vec3& origin : {Vec3{}, Vec3{5e5, 6e6, -2e3}}) {
            const auto positions = cloud(random, 400, size, origin);
            EXPECT_EQ(clusters_within(positions, 1), clusters_of_all_pairs(positions, 1)) << size;
        }
    }
}

// So many in a few cubes that not all pairs are compared.
TEST(NearWeld, JoinsTheSameInACrowd) {
    std::mt19937 random(2);
    for (const double size : {2.0, 12.0, 20.0}) {
        const auto positions = cloud(random, 6000, size);
        EXPECT_EQ(clusters_within(positions, 1), clusters_of_all_pairs(positions, 1)) << size;
    }
    // Two crowds farther apart than the tolerance, and a third that links them.
    auto positions = cloud(random, 3000, 0.3);
    const auto beyond = cloud(random, 3000, 0.3, {1.9, 0, 0});
    positions.insert(positions.end(), beyond.begin(), beyond.end());
    auto clusters = clusters_within(positions, 1);
    EXPECT_EQ(clusters, clusters_of_all_pairs(positions, 1));
    EXPECT_EQ(std::ranges::count(clusters, 0u), 3000);
    positions.push_back({1.1, 0.15, 0.15});
    clusters = clusters_within(positions, 1);
    EXPECT_EQ(std::ranges::count(clusters, 0u), 6001);
}

TEST(NearWeld, TakesLittleTimeWhereAStrayPointMakesTheToleranceLarge) {
    std::mt19937 random(3);
    for (const double size : {10.0, 60.0}) {
        const auto positions = cloud(random, 150000, size);
        const std::clock_t start = std::clock();
        const auto clusters = clusters_within(positions, 1);
        const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
        EXPECT_LT(seconds, 8) << "all pairs in a cube would take minutes";
        EXPECT_EQ(clusters[0], 0u);
    }
}

TEST(NearWeld, TakesATinyToleranceForWhatItIs) {
    std::mt19937 random(4);
    auto positions = cloud(random, 20000, 1e6);
    positions.push_back(positions[7]);
    for (const double tolerance : {1e-30, 1e-300}) {
        const auto clusters = clusters_within(positions, tolerance);
        EXPECT_EQ(clusters.back(), 7u);
        for (std::uint32_t i = 0; i + 1 < clusters.size(); ++i) ASSERT_EQ(clusters[i], i);
    }
}

}  // namespace
}  // namespace geomend::topology
