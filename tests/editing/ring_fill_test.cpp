// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/ring_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/vectors.h"

namespace geomend::editing {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const auto nothing_barred = [](std::uint32_t, std::uint32_t) { return false; };

Ring ring_of(std::vector<Vec3> places) {
    Ring ring;
    ring.on_trace.assign(places.size(), 0);
    ring.places = std::move(places);
    return ring;
}

bool has_diagonal(const Triangles& all, std::uint32_t a, std::uint32_t b) {
    return std::ranges::count_if(all, [&](const auto& t) { return std::ranges::count(t, a) + std::ranges::count(t, b) == 2; }) == 2;
}

double area_of(const Ring& ring, const Triangles& all) {
    double sum = 0;
    for (const auto& [a, b, c] : all) {
        const Vec3 n = cross(minus(ring.places[b], ring.places[a]), minus(ring.places[c], ring.places[a]));
        EXPECT_GT(n[2], 0) << "none is turned over";
        sum += n[2] / 2;
    }
    return sum;
}

// N. Euler's acceptance test 14.
TEST(RingFill, AQuadTakesItsShorterDiagonal) {
    const Ring ring = ring_of({{-0.5, 0, 0}, {0, -1, 0}, {0.5, 0, 0}, {0, 1, 0}});
    const auto filled = fill_ring(ring, {0, 0, 0}, {1e-9, 1e-9}, nothing_barred);
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->size(), 2u);
    EXPECT_TRUE(has_diagonal(*filled, 0, 2));
}

TEST(RingFill, AQuadOnATraceGetsBackTheEdgeThatWasCut) {
    Ring ring = ring_of({{-0.5, 0, 0}, {0, -1, 0}, {0.5, 0, 0}, {0, 1, 0}});
    ring.on_trace = {1, 0, 1, 0};
    const auto filled = fill_ring(ring, {0, 0, 0}, {1e-9, 1e-9}, nothing_barred);
    ASSERT_TRUE(filled);
    EXPECT_TRUE(has_diagonal(*filled, 1, 3)) << "the one between what is not on the trace";
}

TEST(RingFill, AnEdgeThatIsThereElsewhereIsNotMadeTwice) {
    const Ring ring = ring_of({{-0.5, 0, 0}, {0, -1, 0}, {0.5, 0, 0}, {0, 1, 0}});
    const auto filled = fill_ring(ring, {0, 0, 0}, {1e-9, 1e-9},
                                  [](std::uint32_t a, std::uint32_t b) { return std::min(a, b) == 0 && std::max(a, b) == 2; });
    ASSERT_TRUE(filled);
    EXPECT_TRUE(has_diagonal(*filled, 1, 3));
}

TEST(RingFill, AConcavePentagonIsFilledInside) {
    const Ring ring = ring_of({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
    const auto filled = fill_ring(ring, {2, 0.5, 0}, {1e-9, 1e-9}, nothing_barred);
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->size(), 3u);
    EXPECT_NEAR(area_of(ring, *filled), 10, 1e-12);
}

TEST(RingFill, OverABendTheEdgeOfTheBendComesBack) {
    // The point lies on the ridge from place 1 to place 3; places 0 and 2 lie 45 degrees below, so near that the other diagonal is shorter.
    const Ring ring = ring_of({{-0.5, 0, -0.5}, {0, -2, 0}, {0.5, 0, -0.5}, {0, 2, 0}});
    const auto filled = fill_ring(ring, {0, 0, 0}, {1e-9, 1e-9}, nothing_barred);
    ASSERT_TRUE(filled);
    EXPECT_TRUE(has_diagonal(*filled, 1, 3));
    EXPECT_FALSE(fill_ring(ring, {0, 0, 0.01}, {1e-9, 1e-9}, nothing_barred)) << "a point off the ridge is no trace of a cut";
}

TEST(RingFill, ABorderThatRunsOnStraightIsFilledOnItsSide) {
    Ring ring = ring_of({{1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}});
    ring.closed = false;
    const auto filled = fill_ring(ring, {0, 0, 0}, {1e-9, 1e-9}, nothing_barred);
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->size(), 2u);
    EXPECT_NEAR(area_of(ring, *filled), 2, 1e-12);
    EXPECT_FALSE(fill_ring(ring, {0, 0, 0}, {1e-9, 1e-9}, [](std::uint32_t a, std::uint32_t b) { return a == 0 && b == 3; }))
        << "the edge along the border is new, too";
}

TEST(RingFill, FarFromTheOriginItIsTheSame) {
    Ring ring = ring_of({{-0.5, 0, -0.5}, {0, -2, 0}, {0.5, 0, -0.5}, {0, 2, 0}});
    for (Vec3& p : ring.places) p = plus(p, {512345, 6234567, -2500});
    const auto filled = fill_ring(ring, {512345, 6234567, -2500}, {1e-6, 1e-6}, nothing_barred);
    ASSERT_TRUE(filled);
    EXPECT_TRUE(has_diagonal(*filled, 1, 3));
}

}  // namespace
}  // namespace geomend::editing
