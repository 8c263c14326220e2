// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/lip_pairs.h"

#include <gtest/gtest.h>

#include <numbers>

namespace geomend::editing {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs pairs_at(std::vector<double> degrees, double most = 45) {
    for (double& d : degrees) d *= std::numbers::pi / 180;
    return lip_pairs(degrees, most * std::numbers::pi / 180);
}

// N. Euler's acceptance test 11: the clause of coplanarity.
TEST(LipPairs, TwoLipsAreStitchedUpToAQuarterOfARightAngleFromStraight) {
    EXPECT_EQ(pairs_at({0, 140}), (Pairs{{0, 1}}));
    EXPECT_EQ(pairs_at({0, 130}), Pairs{});
    EXPECT_EQ(pairs_at({0, 90}), Pairs{}) << "the edge of a cube";
    EXPECT_EQ(pairs_at({0, 135}), (Pairs{{0, 1}}));
    EXPECT_EQ(pairs_at({0, 225}), (Pairs{{0, 1}}));
}

TEST(LipPairs, OfSeveralLipsThoseAreStitchedThatGoOnIntoEachOther) {
    EXPECT_EQ(pairs_at({0, 90, 180}), (Pairs{{0, 2}}));
    EXPECT_EQ(pairs_at({0, 90, 180, 270}), (Pairs{{0, 2}, {1, 3}}));
    EXPECT_EQ(pairs_at({0, 90, 180 + 22, 270}), (Pairs{{0, 2}, {1, 3}})) << "for four of them up to 22.5 degrees";
    EXPECT_EQ(pairs_at({0, 90, 180 + 23, 270}), (Pairs{{1, 3}}));
}

TEST(LipPairs, TheStraightestPairGoesFirst) {
    EXPECT_EQ(pairs_at({0, 170, 181}), (Pairs{{0, 2}}));
    EXPECT_EQ(pairs_at({-90, 80, 91}), (Pairs{{0, 2}})) << "wherever the angles are counted from";
}

}  // namespace
}  // namespace geomend::editing
