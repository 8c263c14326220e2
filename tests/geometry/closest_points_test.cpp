// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/closest_points.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <span>

#include "exact_reference.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"

namespace geomend {
namespace {

using Corners = std::array<Vec3, 3>;

double length(const Vec3& d) { return std::sqrt(dot(d, d)); }

/// The closest points of convex things are those from where no corner lies on the near side of the plane across the connection.
void expect_smallest(const Closest& c, std::span<const Vec3> first, std::span<const Vec3> second, double size) {
    const Vec3 way = minus(c.on_second, c.on_first);
    EXPECT_NEAR(length(way), c.distance, 1e-12 * size);
    for (const Vec3& p : first) EXPECT_LE(dot(minus(p, c.on_first), way), 1e-11 * size * size);
    for (const Vec3& p : second) EXPECT_GE(dot(minus(p, c.on_second), way), -1e-11 * size * size);
}

/// The point is made of the corners of its part only.
void expect_on_part(const Vec3& point, unsigned part, std::span<const Vec3> corners, double size) {
    ASSERT_NE(part, 0u);
    std::vector<Vec3> used;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if ((part >> i & 1u) != 0) used.push_back(corners[i]);
    }
    if (used.size() == 1) {
        EXPECT_EQ(point, used[0]);
    } else if (used.size() == 2) {
        EXPECT_LE(length(cross(minus(used[1], used[0]), minus(point, used[0]))), 1e-11 * size * length(minus(used[1], used[0])));
    } else {
        const Vec3 n = cross(minus(used[1], used[0]), minus(used[2], used[0]));
        EXPECT_LE(std::abs(dot(n, minus(point, used[0]))), 1e-11 * size * length(n));
    }
}

class RandomPoints {
public:
    explicit RandomPoints(unsigned seed) : random_(seed) {}
    Vec3 operator()(double size, const Vec3& offset) {
        return plus(offset, {size * any_(random_), size * any_(random_), size * any_(random_)});
    }

private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> any_{-1, 1};
};

TEST(ClosestPoints, AreTheClosest) {
    RandomPoints any(5);
    for (int round = 0; round < 4000; ++round) {
        const double size = round % 3 == 0 ? 1e-3 : 1;
        const Vec3 apart = times(size * (round % 5), {1, 0.5, -0.25});
        const Corners a{any(size, {}), any(size, {}), any(size, {})}, b{any(size, apart), any(size, apart), any(size, apart)};
        const Closest p = closest_points(b[0], a);
        expect_smallest(p, std::array<Vec3, 1>{b[0]}, a, 8 * size);
        expect_on_part(p.on_second, p.second_part, a, size);
        const std::array<Vec3, 2> s{b[0], b[1]};
        const Closest q = closest_points(s, a);
        if (q.distance > 0) {
            expect_smallest(q, s, a, 8 * size);
            expect_on_part(q.on_first, q.first_part, s, size);
            expect_on_part(q.on_second, q.second_part, a, size);
        }
        const std::vector<Vec3> v{a[0], a[1], a[2], b[0], b[1], b[2]};
        if (meeting(v, {0, 1, 2}, {3, 4, 5}).kind == Meeting::none) {
            const Closest t = closest_points(a, b);
            expect_smallest(t, a, b, 8 * size);
            expect_on_part(t.on_first, t.first_part, a, size);
            expect_on_part(t.on_second, t.second_part, b, size);
        }
    }
}

TEST(ClosestPoints, HaveKnownPlacesAndParts) {
    const Corners t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    const Closest above = closest_points(Vec3{1, 1, 3}, t);
    EXPECT_EQ(above.distance, 3);
    EXPECT_EQ(above.on_second, (Vec3{1, 1, 0}));
    EXPECT_EQ(above.second_part, 7u);
    const Closest beside = closest_points(Vec3{1, -3, 4}, t);
    EXPECT_EQ(beside.distance, 5);
    EXPECT_EQ(beside.second_part, 3u) << "inside the edge of corners 0 and 1";
    const Closest corner = closest_points(Vec3{-3, -4, 0}, t);
    EXPECT_EQ(corner.distance, 5);
    EXPECT_EQ(corner.on_second, t[0]);
    EXPECT_EQ(corner.second_part, 1u);
    const Closest edges = closest_points(std::array<Vec3, 2>{{{2, -1, -5}, {2, -1, 5}}}, t);
    EXPECT_EQ(edges.distance, 1);
    EXPECT_EQ(edges.first_part, 3u);
    EXPECT_EQ(edges.second_part, 3u);
}

TEST(ClosestPoints, OfDegenerateTrianglesAreThoseOfWhatIsLeft) {
    EXPECT_EQ(closest_points(Vec3{1, 2, 0}, {{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}}).distance, 2);
    EXPECT_EQ(closest_points(Vec3{3, 4, 0}, {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}).distance, 5);
    EXPECT_EQ(closest_points(std::array<Vec3, 2>{{{1, 2, 0}, {1, 2, 0}}}, {{{0, 0, 0}, {4, 0, 0}, {4, 0, 0}}}).distance, 2);
}

TEST(ClosestPoints, KeepSmallGapsFarFromTheOrigin) {
    const Vec3 o{451234.5, 6812345.25, -1200};
    const Corners t{{o, plus(o, {4, 0, 0}), plus(o, {0, 4, 0})}};
    EXPECT_EQ(closest_points(plus(o, {1, 1, 0x1p-30}), t).distance, 0x1p-30);
}

// All segments and triangles with their ends at small integers.
TEST(Meets, AgreesWithFractions) {
    std::mt19937 random(6);
    int yes = 0, no = 0;
    for (int round = 0; round < 20000; ++round) {
        std::uniform_int_distribution<int> any(0, 1 + round % 4);
        std::array<Vec3, 5> v{};
        for (Vec3& p : v) p = {double(any(random)), double(any(random)), round % 3 == 0 ? 1.0 : double(any(random))};
        if (in_line(v[0], v[1], v[2]) || v[3] == v[4]) continue;
        const test::Corners3 t{test::exact(v[0]), test::exact(v[1]), test::exact(v[2])};
        // As a triangle that has no area beside the segment's: twice the same corner.
        const test::Point p = test::exact(v[3]), q = test::exact(v[4]);
        const test::Point n = test::cross(t[1] - t[0], t[2] - t[0]);
        bool expected = test::CommonPart::holds(t, p) || test::CommonPart::holds(t, q);
        const test::Fraction from = test::dot(n, p - t[0]), to = test::dot(n, q - t[0]);
        if (from.sign() * to.sign() < 0) {
            const test::Fraction share = from / (from - to);
            const test::Point d = q - p;
            expected = expected || test::CommonPart::holds(t, {p[0] + share * d[0], p[1] + share * d[1], p[2] + share * d[2]});
        }
        if (from.sign() == 0 && to.sign() == 0 && !expected) {
            // Both ends outside in the plane: raised to a triangle, the segment meets it in a point or a segment.
            const test::Point top{p[0] + n[0], p[1] + n[1], p[2] + n[2]};
            expected = test::CommonPart(t, {p, q, top}).dimension() >= 0;
        }
        ASSERT_EQ(meets({v[3], v[4]}, {v[0], v[1], v[2]}), expected) << "round " << round;
        ASSERT_EQ(closest_points(std::array<Vec3, 2>{v[3], v[4]}, {v[0], v[1], v[2]}).distance == 0, expected);
        ++(expected ? yes : no);
    }
    EXPECT_GT(yes, 1000);
    EXPECT_GT(no, 1000);
}

}  // namespace
}  // namespace geomend
