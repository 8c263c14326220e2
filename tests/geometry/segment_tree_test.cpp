// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/segment_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "geometry/vectors.h"

namespace geomend {
namespace {

double between(const Segment& a, double s, const Segment& b, double t) {
    const Vec3 d = minus(plus(a[0], times(s, minus(a[1], a[0]))), plus(b[0], times(t, minus(b[1], b[0]))));
    return std::sqrt(dot(d, d));
}

// The distance of two segments by narrowing squares of parameters: slow, but nothing can go wrong. It is convex in both.
double searched_distance(const Segment& a, const Segment& b) {
    double low_s = 0, high_s = 1, best = HUGE_VAL;
    const auto over_t = [&](double s) {
        double low = 0, high = 1;
        for (int k = 0; k < 100; ++k) {
            const double x = low + (high - low) / 3, y = high - (high - low) / 3;
            (between(a, s, b, x) < between(a, s, b, y) ? high : low) = between(a, s, b, x) < between(a, s, b, y) ? y : x;
        }
        return between(a, s, b, low);
    };
    for (int k = 0; k < 100; ++k) {
        const double x = low_s + (high_s - low_s) / 3, y = high_s - (high_s - low_s) / 3;
        const double at_x = over_t(x), at_y = over_t(y);
        best = std::min({best, at_x, at_y});
        if (at_x < at_y) high_s = y;
        else low_s = x;
    }
    return best;
}

Segment random_segment(std::mt19937& random, double size, int kind) {
    std::uniform_real_distribution<double> place(0, 10), way(-size, size);
    std::uniform_int_distribution<int> whole(0, 3);
    Segment s;
    for (std::size_t k = 0; k < 3; ++k) {
        s[0][k] = kind == 0 ? place(random) : whole(random);
        s[1][k] = kind == 0 ? s[0][k] + way(random) : whole(random);
    }
    return s;
}

TEST(SegmentDistance, IsTheLeastThatASearchFinds) {
    std::mt19937 random(7);
    for (int round = 0; round < 2000; ++round) {
        const Segment a = random_segment(random, 3, round % 2), b = random_segment(random, 3, round % 2);
        const SegmentDistance near = closest_points(a, b);
        EXPECT_NEAR(near.distance, searched_distance(a, b), 1e-6) << round;
        EXPECT_NEAR(near.distance, between(a, near.along_first, b, near.along_second), 1e-12);
        const Vec3 d = minus(near.on_first, near.on_second);
        EXPECT_NEAR(near.distance, std::sqrt(dot(d, d)), 1e-12);
    }
}

TEST(SideBySide, IsTheCommonPartOfSegmentsOnOneLine) {
    const Segment a{{{0, 0, 0}, {10, 0, 0}}};
    EXPECT_DOUBLE_EQ(side_by_side(a, {{{4, 0, 0}, {20, 0, 0}}}, 0.01).length, 6);
    EXPECT_DOUBLE_EQ(side_by_side(a, {{{20, 0, 0}, {4, 0, 0}}}, 0.01).length, 6) << "the other way round";
    EXPECT_DOUBLE_EQ(side_by_side(a, {{{2, 0.005, 0}, {3, 0, 0.005}}}, 0.01).length, 1);
    EXPECT_EQ(side_by_side(a, {{{2, 0.02, 0}, {3, 0.02, 0}}}, 0.01).length, 0) << "too far away";
    EXPECT_EQ(side_by_side(a, {{{2, -1, 0}, {3, 1, 0}}}, 0.01).length, 0) << "crosses";
    EXPECT_EQ(side_by_side(a, {{{11, 0, 0}, {12, 0, 0}}}, 0.01).length, 0);
    EXPECT_EQ(side_by_side(a, {{{5, 0, 0}, {5, 3, 0}}}, 0.01).length, 0) << "square to it";
}

TEST(SegmentTree, FindsEveryPairThatComesNear) {
    std::mt19937 random(11);
    for (const std::size_t count : {0u, 1u, 2u, 5u, 40u, 300u}) {
        std::vector<Segment> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(random_segment(random, i % 20 == 0 ? 10 : 0.4, 0));
        const double distance = 0.05;
        std::set<std::pair<std::uint32_t, std::uint32_t>> visited;
        SegmentTree(all, distance).visit_pairs([&](std::uint32_t a, std::uint32_t b) {
            EXPECT_TRUE(visited.insert(std::minmax(a, b)).second) << "a pair came twice";
            return true;
        });
        for (std::uint32_t a = 0; a < count; ++a) {
            for (std::uint32_t b = a + 1; b < count; ++b) {
                if (closest_points(all[a], all[b]).distance <= distance) {
                    EXPECT_TRUE(visited.contains({a, b})) << a << ' ' << b;
                }
            }
        }
    }
}

TEST(SegmentTree, StopsWhereItIsToldTo) {
    const std::vector<Segment> all(100, Segment{{{0, 0, 0}, {1, 1, 1}}});
    int visits = 0;
    SegmentTree(all, 0).visit_pairs([&](std::uint32_t, std::uint32_t) { return ++visits < 10; });
    EXPECT_EQ(visits, 10);
}

TEST(SegmentTree, VisitsFewPairsOfALongLine) {
    std::vector<Segment> line;
    for (int i = 0; i < 20000; ++i) line.push_back({{{double(i), std::sin(0.1 * i), 0}, {i + 1.0, std::sin(0.1 * (i + 1)), 0}}});
    std::size_t visits = 0;
    SegmentTree(line, 1e-3).visit_pairs([&](std::uint32_t, std::uint32_t) { return ++visits > 0; });
    EXPECT_LT(visits, 6 * line.size());
}

}  // namespace
}  // namespace geomend
