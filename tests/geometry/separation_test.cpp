// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/separation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exact_reference.h"
#include "geometry/predicates.h"
#include "soups.h"

namespace geomend {
namespace {

struct Shared {
    Corners own = 0, its = 0;
};

Shared shared(const Triangle& a, const Triangle& b) {
    Shared s;
    for (unsigned i = 0; i < 3; ++i) {
        for (unsigned j = 0; j < 3; ++j) {
            if (a[i] == b[j]) s.own |= 1u << i, s.its |= 1u << j;
        }
    }
    return s;
}

bool clear(const std::vector<Vec3>& v, const Triangle& a, const Triangle& b) {
    const std::array<Vec3, 3> p{v[a[0]], v[a[1]], v[a[2]]}, q{v[b[0]], v[b[1]], v[b[2]]};
    const Shared s = shared(a, b);
    return Separator(p).clear_of(q, s.own, s.its) || Separator(q).clear_of(p, s.its, s.own);
}

TEST(Separator, NeverSaysClearOfTrianglesThatMeet) {
    std::mt19937 random(21);
    int said = 0;
    for (int round = 0; round < 40000; ++round) {
        std::uniform_int_distribution<int> any(0, 1 + round % 5);
        std::vector<Vec3> v;
        for (int i = 0; i < 6; ++i) v.push_back({double(any(random)), double(any(random)), round % 7 == 0 ? 0 : double(any(random))});
        Triangle b{3, 4, 5};
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(round % 3); ++i) b[(i + 1) % 3] = 2 - i;
        if (in_line(v[0], v[1], v[2]) || in_line(v[b[0]], v[b[1]], v[b[2]])) continue;
        if (!clear(v, {0, 1, 2}, b)) continue;
        ++said;
        ASSERT_EQ(test::exact_meeting(v, {0, 1, 2}, b).kind, Meeting::none) << "round " << round;
    }
    EXPECT_GT(said, 5000);
}

// A corner is put on the plane, edge or corner of the other triangle, or one bit beside it, far from the origin: plain arithmetic cannot
// know, and must not say that it does.
TEST(Separator, IsNotSureWhereRoundingDecides) {
    std::mt19937 random(22);
    std::uniform_real_distribution<double> any(-1, 1);
    int meeting_pairs = 0;
    for (int round = 0; round < 20000; ++round) {
        const Vec3 offset = round % 2 == 0 ? Vec3{451234.5, 6812345.25, -1200} : Vec3{};
        std::vector<Vec3> v;
        for (int i = 0; i < 6; ++i)
            v.push_back(plus(offset, {any(random), any(random), round % 3 == 0 ? 1e-7 * any(random) : any(random)}));
        const double s = round % 5 == 0 ? 0 : 0.5 * (any(random) + 1), t = round % 5 == 1 ? 0 : (1 - s) * 0.5 * (any(random) + 1);
        v[3] = plus(v[0], plus(times(s, minus(v[1], v[0])), times(t, minus(v[2], v[0]))));
        Triangle b{3, 4, 5};
        if (round % 4 == 0) b[1] = 1;
        if (in_line(v[0], v[1], v[2]) || in_line(v[b[0]], v[b[1]], v[b[2]])) continue;
        if (meeting(v, {0, 1, 2}, b).kind == Meeting::none) continue;
        ++meeting_pairs;
        ASSERT_FALSE(clear(v, {0, 1, 2}, b)) << "round " << round;
    }
    EXPECT_GT(meeting_pairs, 5000);
}

TEST(Separator, DecidesAllNeighboursInASurface) {
    for (const double relief : {0.0, 0.3}) {
        test::Soup s;
        s.add_sheet(6, 6, [&](double i, double j) { return Vec3{i, j, 0.5 * i + relief * std::sin(i + 2 * j)}; });
        for (std::size_t a = 0; a < s.triangles.size(); ++a) {
            for (std::size_t b = a + 1; b < s.triangles.size(); ++b)
                EXPECT_TRUE(clear(s.vertices, s.triangles[a], s.triangles[b])) << a << ' ' << b;
        }
    }
}

}  // namespace
}  // namespace geomend
