// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/side_overlap.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace geomend::grid {
namespace {

// Area in the plane of fraction and depth.
double area(const Overlap& shared) {
    double sum = 0;
    std::array<std::array<double, 2>, 6> p{};
    for (std::uint32_t c = 0; c < shared.count; ++c) {
        const OverlapCorner& k = shared.corners[c];
        p[c] = {k.u, k.first[0] + k.u * (k.first[1] - k.first[0])};
    }
    for (std::uint32_t c = 0; c < shared.count; ++c) {
        const auto &a = p[c], &b = p[(c + 1) % shared.count];
        sum += (a[0] * b[1] - b[0] * a[1]) / 2;
    }
    return sum;
}

TEST(SideOverlap, equal_sides_share_all) {
    const Side side{0, 1, 10, 12};
    const Overlap shared = overlap(side, side);
    EXPECT_EQ(shared.count, 4u);
    EXPECT_DOUBLE_EQ(area(shared), 10.5);
}

TEST(SideOverlap, sides_that_touch_share_nothing) {
    EXPECT_EQ(overlap({0, 0, 10, 10}, {10, 10, 20, 20}).count, 0u);
    EXPECT_FALSE(overlaps({0, 0, 10, 10}, {10, 10, 20, 20}));
    EXPECT_FALSE(overlaps({0, 0, 0, 0}, {-5, -5, 5, 5}));
}

TEST(SideOverlap, a_wedge_against_a_thrown_side_shares_a_triangle) {
    // [0,10] against a side that starts at 5 on one pillar and at 15 on the other: above depth 10 until half way.
    const Overlap shared = overlap({0, 0, 10, 10}, {5, 15, 20, 30});
    EXPECT_EQ(shared.count, 3u);
    EXPECT_DOUBLE_EQ(area(shared), 0.5 * 0.5 * 5);
}

TEST(SideOverlap, edges_that_cross_twice_share_six_corners) {
    const Overlap shared = overlap({0, 2, 10, 12}, {2, 0, 12, 10});
    EXPECT_EQ(shared.count, 6u);
    EXPECT_DOUBLE_EQ(area(shared), 12 - 1.5 - 1.5);
}

TEST(SideOverlap, sides_that_meet_in_the_middle_only_are_found) {
    // The tops cross the bottoms near both pillars: the share reaches neither.
    const Side valley{0, 20, 4, 24}, ridge{20, 0, 24, 4};
    EXPECT_TRUE(overlaps(valley, ridge));
    const Overlap shared = overlap(valley, ridge);
    EXPECT_EQ(shared.count, 4u);
    for (const OverlapCorner& c : shared.polygon()) EXPECT_TRUE(c.u > 0 && c.u < 1);
}

TEST(SideOverlap, corners_off_the_pillars_lie_where_both_pillars_have_their_depth) {
    const OverlapCorner corner{0.5, {0, 10}, {10, 0}};
    const Vec3 p = position(corner, [](int pillar, double depth) { return pillar == 0 ? Vec3{depth, 0, depth} : Vec3{0, 8, depth}; });
    EXPECT_EQ(p, (Vec3{2.5, 4, 5}));
}

RC_GTEST_PROP(SideOverlap, the_share_is_the_area_between_the_deeper_top_and_the_higher_bottom, ()) {
    const auto depth = [] { return double(*rc::gen::inRange(0, 12)); };
    const auto side = [&] {
        const double a = depth(), b = depth();
        return Side{a, b, a + depth(), b + depth()};
    };
    const Side p = side(), q = side();
    // The integral of max(0, lowest bottom - deepest top) over the fraction, by many slices.
    double expected = 0;
    constexpr int slices = 4000;
    for (int s = 0; s < slices; ++s) {
        const double u = (s + 0.5) / slices;
        const auto at = [&](double a, double b) { return a + u * (b - a); };
        const double top = std::max(at(p.top_a, p.top_b), at(q.top_a, q.top_b));
        const double bottom = std::min(at(p.bottom_a, p.bottom_b), at(q.bottom_a, q.bottom_b));
        expected += std::max(0.0, bottom - top) / slices;
    }
    const Overlap shared = overlap(p, q);
    RC_ASSERT(std::abs(area(shared) - expected) < 1e-3);
    RC_ASSERT(overlaps(p, q) == (shared.count > 0));
}

}  // namespace
}  // namespace geomend::grid
