// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace geomend {
namespace {

TEST(DisjointSets, AreRootedAtTheirSmallestMemberWhateverTheOrder) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        constexpr std::uint32_t size = 60, classes = 7;  // i and j belong together when they are equal modulo 7
        DisjointSets sets(size);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        for (std::uint32_t i = classes; i < size; ++i) pairs.emplace_back(i, i - classes);
        std::shuffle(pairs.begin(), pairs.end(), random);
        for (const auto& [a, b] : pairs) random() % 2 == 0 ? sets.join(a, b) : sets.join(b, a);
        for (std::uint32_t i = 0; i < size; ++i) EXPECT_EQ(sets.root(i), i % classes);
        const auto roots = std::move(sets).roots();
        for (std::uint32_t i = 0; i < size; ++i) EXPECT_EQ(roots[i], i % classes);
    }
}

TEST(DisjointSets, HoldEachNumberAloneAtFirst) {
    const auto roots = DisjointSets(5).roots();
    EXPECT_EQ(roots, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace geomend
