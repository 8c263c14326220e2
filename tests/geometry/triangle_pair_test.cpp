// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/triangle_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "exact_reference.h"
#include "geometry/predicates.h"

namespace geomend {

std::ostream& operator<<(std::ostream& out, Meeting kind) {
    return out << std::array{"none", "point", "touch", "crossing", "overlap"}[static_cast<std::size_t>(kind)];
}

namespace {

constexpr std::array<std::array<std::size_t, 3>, 6> orders{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

Triangle reordered(const Triangle& t, const std::array<std::size_t, 3>& order) { return {t[order[0]], t[order[1]], t[order[2]]}; }

/// The kind, which must be the same for every order of the corners and of the two; and so must the segment, up to its direction.
TriangleMeeting in_all_orders(const std::vector<Vec3>& v, const Triangle& a, const Triangle& b) {
    const TriangleMeeting first = meeting(v, a, b);
    for (const auto& i : orders) {
        for (const auto& j : orders) {
            for (const bool swapped : {false, true}) {
                const Triangle p = reordered(a, i), q = reordered(b, j);
                const TriangleMeeting again = swapped ? meeting(v, q, p) : meeting(v, p, q);
                EXPECT_EQ(again.kind, first.kind);
                if (first.kind != Meeting::crossing && first.kind != Meeting::touch) continue;
                EXPECT_TRUE(again.segment == first.segment || again.segment == (std::array<Vec3, 2>{first.segment[1], first.segment[0]}));
            }
        }
    }
    return first;
}

const Triangle one{0, 1, 2}, two{3, 4, 5};

/// How the triangle (0,0,0), (4,0,0), (0,4,0) meets another one that shares nothing with it.
TriangleMeeting against_flat(const Vec3& p, const Vec3& q, const Vec3& r) {
    return in_all_orders({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, p, q, r}, one, two);
}

bool same_ends(const TriangleMeeting& found, const Vec3& p, const Vec3& q) {
    return found.segment == std::array<Vec3, 2>{p, q} || found.segment == std::array<Vec3, 2>{q, p};
}

TEST(Meeting, PiercingIsACrossing) {
    const TriangleMeeting edge = against_flat({1, 1, -1}, {1, 1, 3}, {9, 1, 1});
    EXPECT_EQ(edge.kind, Meeting::crossing);
    EXPECT_TRUE(same_ends(edge, {1, 1, 0}, {3, 1, 0}));
    const TriangleMeeting tip = against_flat({1, 1, -1}, {1, 1, 1}, {2, 1, 1});
    EXPECT_EQ(tip.kind, Meeting::crossing);
    EXPECT_TRUE(same_ends(tip, {1, 1, 0}, {1.5, 1, 0}));
    EXPECT_EQ(against_flat({1, 1, 0}, {1, 1, 5}, {2, 1, -5}).kind, Meeting::crossing) << "from a corner to the middle of its other edge";
}

TEST(Meeting, AnEdgeInTheOthersPlaneIsATouch) {
    const TriangleMeeting inside = against_flat({1, 1, 0}, {2, 1, 0}, {1, 1, 5});
    EXPECT_EQ(inside.kind, Meeting::touch);
    EXPECT_TRUE(same_ends(inside, {1, 1, 0}, {2, 1, 0}));
    const TriangleMeeting leaving = against_flat({1, 1, 0}, {9, 1, 0}, {1, 1, 5});
    EXPECT_EQ(leaving.kind, Meeting::touch);
    EXPECT_TRUE(same_ends(leaving, {1, 1, 0}, {3, 1, 0}));
    EXPECT_EQ(against_flat({1, 0, 0}, {2, 0, 0}, {1, 1, 5}).kind, Meeting::touch) << "edges on one line";
    EXPECT_EQ(against_flat({1, 0, 3}, {2, 0, 3}, {1, 0, -3}).kind, Meeting::touch) << "an edge of the first in the plane of the second";
    EXPECT_EQ(against_flat({-1, 0, 0}, {-3, 0, 0}, {1, 1, 5}).kind, Meeting::none);
    EXPECT_EQ(against_flat({5, 5, 0}, {7, 5, 0}, {1, 1, 5}).kind, Meeting::none);
}

TEST(Meeting, OnePointIsAPoint) {
    const TriangleMeeting tip = against_flat({1, 1, 0}, {2, 1, 4}, {1, 2, 4});
    EXPECT_EQ(tip.kind, Meeting::point);
    EXPECT_TRUE(same_ends(tip, {1, 1, 0}, {1, 1, 0}));
    EXPECT_EQ(against_flat({0, 0, 0}, {2, 1, 4}, {1, 2, 4}).kind, Meeting::point) << "equal positions without a shared number";
    EXPECT_EQ(against_flat({1, 0, 0}, {2, -1, 4}, {1, -2, 4}).kind, Meeting::point) << "a corner on an edge";
    const TriangleMeeting edges = against_flat({2, 0, -1}, {2, 0, 1}, {2, -4, 0});
    EXPECT_EQ(edges.kind, Meeting::point) << "edges that cross, all else outside";
    EXPECT_TRUE(same_ends(edges, {2, 0, 0}, {2, 0, 0}));
    EXPECT_EQ(against_flat({9, 9, 0}, {2, 1, 4}, {1, 2, 4}).kind, Meeting::none);
}

TEST(Meeting, InOnePlane) {
    EXPECT_EQ(against_flat({1, 1, 0}, {9, 1, 0}, {1, 9, 0}).kind, Meeting::overlap);
    EXPECT_EQ(against_flat({1, 1, 0}, {2, 1, 0}, {1, 2, 0}).kind, Meeting::overlap) << "one inside the other";
    EXPECT_EQ(against_flat({0, 0, 0}, {4, 0, 0}, {0, 4, 0}).kind, Meeting::overlap) << "the same place";
    EXPECT_EQ(against_flat({0, 0, 0}, {4, 0, 0}, {0, -4, 0}).kind, Meeting::touch);
    EXPECT_EQ(against_flat({1, 0, 0}, {2, 0, 0}, {1, -4, 0}).kind, Meeting::touch);
    EXPECT_EQ(against_flat({1, 0, 0}, {2, -1, 0}, {1, -4, 0}).kind, Meeting::point);
    EXPECT_EQ(against_flat({4, 0, 0}, {9, 0, 0}, {9, 1, 0}).kind, Meeting::point);
    EXPECT_EQ(against_flat({5, 0, 0}, {9, 0, 0}, {9, 1, 0}).kind, Meeting::none);
    EXPECT_EQ(against_flat({3, 3, 0}, {9, 0, 0}, {9, 9, 0}).kind, Meeting::none);
    EXPECT_EQ(against_flat({-1, 2, 0}, {2, -1, 0}, {-9, -9, 0}).kind, Meeting::overlap) << "a corner cut off";
    EXPECT_TRUE(same_ends(against_flat({0, 0, 0}, {9, 0, 0}, {9, 9, 0}), {0, 0, 0}, {4, 0, 0}));
}

TEST(Meeting, SharedCornersAndEdgesAreNoContact) {
    const std::vector<Vec3> v = {{0, 0, 0}, {4, 0, 0},   {0, 4, 0}, {4, 4, 0}, {1, 1, 0},
                                 {0, 0, 5}, {-3, -1, 0}, {2, 0, 0}, {9, 0, 0}, {5, 5, 5}};
    const auto kind = [&](const Triangle& a, const Triangle& b) { return in_all_orders(v, a, b).kind; };
    EXPECT_EQ(kind({0, 1, 2}, {1, 2, 3}), Meeting::none) << "neighbours in a plane";
    EXPECT_EQ(kind({0, 1, 2}, {0, 1, 5}), Meeting::none) << "a fold";
    EXPECT_EQ(kind({0, 1, 2}, {1, 2, 4}), Meeting::overlap) << "folded onto itself";
    EXPECT_EQ(kind({0, 1, 2}, {0, 5, 6}), Meeting::none) << "a shared corner, leaving";
    EXPECT_EQ(kind({0, 1, 2}, {0, 5, 4}), Meeting::touch) << "a shared corner, an edge across the inside";
    EXPECT_EQ(kind({0, 1, 2}, {0, 5, 7}), Meeting::touch) << "a shared corner, edges of different length on one line";
    EXPECT_EQ(kind({0, 1, 2}, {0, 5, 8}), Meeting::touch);
    EXPECT_EQ(kind({0, 1, 2}, {0, 3, 8}), Meeting::overlap);
    EXPECT_EQ(kind({0, 1, 2}, {1, 8, 3}), Meeting::none);
    EXPECT_EQ(kind({0, 1, 2}, {2, 1, 0}), Meeting::overlap) << "the same triangle twice";
}

TEST(Meeting, ASharedCornerAndACrossing) {
    const std::vector<Vec3> v = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {3, 3, -3}};
    const TriangleMeeting found = in_all_orders(v, {0, 1, 2}, {0, 3, 4});
    EXPECT_EQ(found.kind, Meeting::crossing);
    EXPECT_TRUE(same_ends(found, {0, 0, 0}, {1.5, 1.5, 0}));
}

// All triangles that have their corners at integers 0..3 or so: every degenerate position comes many times.
TEST(Meeting, AgreesWithFractions) {
    std::mt19937 random(11);
    std::map<std::pair<unsigned, Meeting>, int> seen;
    for (int round = 0; round < 24000; ++round) {
        const int size = 1 + round % 4;
        std::uniform_int_distribution<int> any(0, size);
        const unsigned shared = static_cast<unsigned>(round / 4) % 3;
        const bool flat = round % 16 == 0;
        std::vector<Vec3> v;
        for (int i = 0; i < 6; ++i) v.push_back({double(any(random)), double(any(random)), flat ? 1.0 : double(any(random))});
        Triangle b = two;
        for (std::uint32_t i = 0; i < shared; ++i) b[i] = i;
        if (in_line(v[0], v[1], v[2]) || in_line(v[b[0]], v[b[1]], v[b[2]])) continue;
        const test::ExactMeeting expected = test::exact_meeting(v, one, b);
        const TriangleMeeting found = round % 20 == 0 ? in_all_orders(v, one, b) : meeting(v, one, b);
        ASSERT_EQ(found.kind, expected.kind) << "round " << round << ", shared " << shared;
        ++seen[{shared, found.kind}];
        if (found.kind == Meeting::none || found.kind == Meeting::overlap) continue;
        for (const test::Point& p : expected.points) {  // two ends, or once or twice the only point
            double nearest = 1e9;
            for (const Vec3& end : found.segment) {
                double far = 0;
                for (std::size_t k = 0; k < 3; ++k) far = std::max(far, std::abs(end[k] - double(p[k].n) / double(p[k].d)));
                nearest = std::min(nearest, far);
            }
            ASSERT_LE(nearest, 1e-12) << "round " << round;
        }
    }
    for (const Meeting kind : {Meeting::none, Meeting::point, Meeting::touch, Meeting::crossing, Meeting::overlap}) {
        EXPECT_GT((seen[{0, kind}]), 100) << kind;
    }
    EXPECT_GT((seen[{1, Meeting::touch}]), 100);
    EXPECT_GT((seen[{1, Meeting::crossing}]), 100);
    EXPECT_GT((seen[{1, Meeting::overlap}]), 100);
    EXPECT_GT((seen[{2, Meeting::overlap}]), 100);
    EXPECT_GT((seen[{2, Meeting::none}]), 100);
}

// The same pairs, sheared onto planes that are not along the axes, moved and scaled without rounding.
TEST(Meeting, IsTheSameInEveryFrame) {
    std::mt19937 random(12);
    for (int round = 0; round < 20000; ++round) {
        std::uniform_int_distribution<int> any(0, 3);
        std::vector<Vec3> v;
        for (int i = 0; i < 6; ++i) v.push_back({double(any(random)), double(any(random)), double(any(random))});
        Triangle b = two;
        if (round % 2 == 0) b[0] = 1;
        if (in_line(v[0], v[1], v[2]) || in_line(v[b[0]], v[b[1]], v[b[2]])) continue;
        const Meeting kind = meeting(v, one, b).kind;
        const Vec3 offset = round % 3 == 0 ? Vec3{451234.5, 6812345.25, -1200} : Vec3{};
        const double scale = std::ldexp(1.0, round % 3 == 1 ? -10 : round % 3 == 2 ? 90 : 2);
        std::vector<Vec3> moved;
        for (const Vec3& p : v) {
            moved.push_back({offset[0] + scale * (3 * p[0] + p[1] - p[2]), offset[1] + scale * (p[0] - 5 * p[1] + 2 * p[2]),
                             offset[2] + scale * (2 * p[0] + p[1] + 7 * p[2])});
        }
        ASSERT_EQ(meeting(moved, one, b).kind, kind) << "round " << round;
    }
}

TEST(Meeting, OneBitDecidesFarFromTheOrigin) {
    const Vec3 o{451234.5, 6812345.25, -1200.125};
    const double up = std::nextafter(o[2], 0.0), down = std::nextafter(o[2], -1e9);
    const auto kind = [&](double lowest) {
        const std::vector<Vec3> v = {o,
                                     {o[0] + 100, o[1], o[2]},
                                     {o[0], o[1] + 100, o[2]},
                                     {o[0] + 20, o[1] + 20, lowest},
                                     {o[0] + 25, o[1] + 20, -1100},
                                     {o[0] + 20, o[1] + 25, -1100}};
        return in_all_orders(v, one, two).kind;
    };
    EXPECT_EQ(kind(up), Meeting::none);
    EXPECT_EQ(kind(o[2]), Meeting::point);
    EXPECT_EQ(kind(down), Meeting::crossing);
}

TEST(Meeting, OfNeedles) {
    const double thin = 1e-12;
    const std::vector<Vec3> v = {{0, 0, 0},     {1000, 0, 0}, {1000, thin, 0}, {500, 1, -1},
                                 {500, -1, -1}, {500, 0, 1},  {500, 1, 1e-9},  {500, -1, 1e-9}};
    EXPECT_EQ(in_all_orders(v, {0, 1, 2}, {3, 4, 5}).kind, Meeting::crossing);
    EXPECT_EQ(in_all_orders(v, {0, 1, 2}, {6, 7, 5}).kind, Meeting::none);
}

// The line along which a surface is crossed comes out in one piece.
TEST(Meeting, NeighboursGetTheSameBitsAtTheirCommonEdge) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> any(-1, 1);
    int checked = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<Vec3> v;
        for (int i = 0; i < 7; ++i) v.push_back({451234.5 + any(random), 6812345.25 + any(random), any(random)});
        const TriangleMeeting a = meeting(v, {0, 1, 2}, {4, 5, 6}), b = meeting(v, {6, 4, 5}, {3, 2, 1});
        if (orientation(v[4], v[5], v[6], v[1]) * orientation(v[4], v[5], v[6], v[2]) >= 0) continue;
        if (a.kind != Meeting::crossing || b.kind != Meeting::crossing) continue;
        // Where the edge 1, 2 passes through the third triangle both segments end there.
        const bool inside = orientation(v[1], v[2], v[4], v[5]) == orientation(v[1], v[2], v[5], v[6]) &&
                            orientation(v[1], v[2], v[5], v[6]) == orientation(v[1], v[2], v[6], v[4]);
        if (!inside) continue;
        ++checked;
        EXPECT_TRUE(a.segment[0] == b.segment[0] || a.segment[0] == b.segment[1] || a.segment[1] == b.segment[0] ||
                    a.segment[1] == b.segment[1]);
    }
    EXPECT_GT(checked, 20);
}

}  // namespace
}  // namespace geomend
