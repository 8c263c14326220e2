// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/triangle_overlap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace geomend::validators {
namespace {

const std::array<Vec3, 3> right{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};

TEST(TwoTriangles, HaveAnAreaInCommon) {
    EXPECT_DOUBLE_EQ(common_area(right, right), 2);
    EXPECT_DOUBLE_EQ(common_area({{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}}}, right), 2) << "wound the other way";
    EXPECT_DOUBLE_EQ(common_area({{{0.5, 0.5, 0}, {1, 0.5, 0}, {0.5, 1, 0}}}, right), 0.125) << "inside";
    EXPECT_NEAR(common_area({{{-9, -9, 0}, {9, -9, 0}, {0, 99, 0}}}, right), 2, 1e-12) << "around";
    EXPECT_DOUBLE_EQ(common_area({{{1, 0, 0}, {3, 0, 0}, {1, 2, 0}}}, right), 0.5) << "across a side";
    EXPECT_DOUBLE_EQ(common_area({{{2, 0, 0}, {2, 2, 0}, {0, 2, 0}}}, right), 0) << "beside";
    EXPECT_DOUBLE_EQ(common_area({{{5, 5, 0}, {6, 5, 0}, {5, 6, 0}}}, right), 0) << "apart";
}

TEST(TwoTriangles, LieOnEachOtherWithinTheTolerance) {
    const auto lifted = [](double z) { return std::array<Vec3, 3>{{{0.5, 0.5, z}, {1, 0.5, z}, {0.5, 1, z}}}; };
    EXPECT_TRUE(lie_on_each_other(lifted(0), right, 1e-6));
    EXPECT_TRUE(lie_on_each_other(lifted(5e-7), right, 1e-6));
    EXPECT_FALSE(lie_on_each_other(lifted(5e-6), right, 1e-6));
    EXPECT_FALSE(lie_on_each_other({{{2, 0, 0}, {2, 2, 0}, {0, 2, 0}}}, right, 1e-6)) << "side by side";
    EXPECT_FALSE(lie_on_each_other({{{2 - 1e-7, 0, 0}, {2, 2, 0}, {0, 2 - 1e-7, 0}}}, right, 1e-6)) << "side by side but for rounding";
    EXPECT_FALSE(lie_on_each_other({{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}}, right, 1e-6)) << "no triangle";
}

TEST(ASegment, LiesOnATriangleForSomeOfItsLength) {
    EXPECT_DOUBLE_EQ(length_on({{{0.25, 0.25, 0}, {1.25, 0.25, 0}}}, right, 0), 1);
    EXPECT_DOUBLE_EQ(length_on({{{-1, 0.5, 0}, {9, 0.5, 0}}}, right, 0), 1.5) << "cut at both sides";
    EXPECT_DOUBLE_EQ(length_on({{{0.5, 0.5, 0}, {0.5, 0.5, 1}}}, right, 0), 0) << "upright";
    EXPECT_DOUBLE_EQ(length_on({{{0.25, 0.25, 1}, {1.25, 0.25, 1}}}, right, 0.5), 0) << "above";
    EXPECT_NEAR(length_on({{{0.25, 0.25, 0}, {1.25, 0.25, 1}}}, right, 0.1), 0.1 * std::sqrt(2), 1e-12) << "leaving it";
    EXPECT_DOUBLE_EQ(length_on({{{3, 3, 0}, {4, 3, 0}}}, right, 0), 0) << "apart";
}

}  // namespace
}  // namespace geomend::validators
