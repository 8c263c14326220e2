// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace geomend {
namespace {

__extension__ typedef __int128 Wide;

int sign(Wide x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

Wide determinant(const std::array<std::array<Wide, 3>, 4>& p) {
    std::array<std::array<Wide, 3>, 3> m{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) m[r][k] = p[r + 1][k] - p[0][k];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

TEST(Orientation, IsPositiveOnTheSideOfTheNormal) {
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, -1e-300}), -1);
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 0}), 0);
    EXPECT_EQ(orientation_2d({0, 0, 9}, {1, 0, -4}, {0, 1, 3}, 2), 1);
    EXPECT_EQ(orientation_2d({9, 0, 0}, {0, 1, 0}, {3, 0, 1}, 0), 1);
    EXPECT_EQ(orientation_2d({0, 9, 0}, {1, 0, 0}, {0, 3, 1}, 1), -1) << "the normal of x, z is minus y";
}

// Points of 38-bit coordinates in a plane, or one unit beside it: the determinant is known in 128 bits, its terms are 1e34.
TEST(Orientation, AgreesWithIntegersWhereTermsCancel) {
    std::mt19937_64 random(7);
    int zero = 0;
    for (int round = 0; round < 20000; ++round) {
        const std::int64_t size = std::int64_t{1} << (5 + round % 33);
        std::uniform_int_distribution<std::int64_t> any(-size, size);
        std::array<std::array<Wide, 3>, 4> p{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) p[i][k] = any(random);
        }
        const Wide s = round % 7 - 3, t = round % 5 - 2;
        for (std::size_t k = 0; k < 3; ++k) p[3][k] = p[0][k] + s * (p[1][k] - p[0][k]) + t * (p[2][k] - p[0][k]);
        if (round % 3 != 0) p[3][static_cast<std::size_t>(round) % 3] += round % 2 == 0 ? 1 : -1;
        std::array<Vec3, 4> v{};
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t k = 0; k < 3; ++k) v[i][k] = static_cast<double>(p[i][k]);
        }
        const Wide det = determinant(p);
        zero += det == 0;
        ASSERT_EQ(orientation(v[0], v[1], v[2], v[3]), sign(det)) << "round " << round;
        ASSERT_EQ(orientation(v[1], v[0], v[2], v[3]), -sign(det));
        ASSERT_EQ(orientation(v[3], v[2], v[1], v[0]), sign(det));
        const double value = six_volumes(v[0], v[1], v[2], v[3]);
        ASSERT_LE(std::abs(value - static_cast<double>(det)), 1e-8 * std::abs(static_cast<double>(det)));
        const Wide area = (p[1][0] - p[0][0]) * (p[3][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[3][0] - p[0][0]);
        ASSERT_EQ(orientation_2d(v[0], v[1], v[3], 2), sign(area));
        for (Vec3& x : v) {
            for (double& c : x) c = std::ldexp(c, round % 2 == 0 ? -290 : 280);
        }
        ASSERT_EQ(orientation(v[0], v[1], v[2], v[3]), sign(det)) << "scaled by a power of two";
        ASSERT_EQ(orientation_2d(v[0], v[1], v[3], 2), sign(area));
    }
    EXPECT_GT(zero, 6000);
}

TEST(Orientation, SeesTheLastBitOfCoordinatesFarFromTheOrigin) {
    const Vec3 a{451234.5, 6812345.25, -1200.125}, b{451334.5, 6812345.25, -1200.125}, c{451234.5, 6812445.25, -1150.125};
    for (const double t : {0.25, 0.5, 0.75}) {
        const Vec3 d{451234.5 + 12.25, 6812345.25 + 100 * t, -1200.125 + 50 * t};
        EXPECT_EQ(orientation(a, b, c, d), 0);
        EXPECT_EQ(orientation(a, b, c, {d[0], d[1], std::nextafter(d[2], 0.0)}), 1);
        EXPECT_EQ(orientation(a, b, c, {d[0], d[1], std::nextafter(d[2], -1e9)}), -1);
        EXPECT_EQ(orientation(a, b, c, {d[0], std::nextafter(d[1], 0.0), d[2]}), 1);
    }
}

TEST(InLine, IsExact) {
    EXPECT_TRUE(in_line({0, 0, 0}, {1, 2, 3}, {3, 6, 9}));
    EXPECT_TRUE(in_line({1, 1, 1}, {1, 1, 1}, {3, 6, 9}));
    EXPECT_FALSE(in_line({0, 0, 0}, {1, 2, 3}, {3, 6, std::nextafter(9.0, 10.0)}));
}

}  // namespace
}  // namespace geomend
