// SPDX-License-Identifier: AGPL-3.0-or-later
// How triangles meet, over many random soups in every frame: the order of the two, of their corners and of the soup, size and
// place must not matter; kinds are compared with fractions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "exact_reference.h"
#include "geometry/intersections.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "soups.h"
#include "support/seeds.h"

namespace geomend {
namespace {

using test::Soup;

/// Triangles over few vertices at integers: shared vertices and edges, pieces of planes, contacts and coincidences of every kind,
/// and positions that are there twice under two numbers.
Soup lattice_soup(unsigned seed) {
    std::mt19937 random(seed);
    Soup s;
    const auto size = static_cast<int>(2 + seed % 4);
    const std::size_t vertices = 6 + random() % 10, triangles = 4 + random() % 10;
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto any = [&] { return double(static_cast<int>(random() % (size + 1))); };
        s.vertices.push_back({any(), any(), seed % 5 == 0 ? 0 : any()});
    }
    for (std::size_t t = 0; t < triangles; ++t) {
        Triangle corners{};
        for (std::uint32_t& v : corners) v = static_cast<std::uint32_t>(random() % vertices);
        s.triangles.push_back(corners);
    }
    return s;
}

bool is_degenerate(const Soup& s, const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || in_line(s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]);
}

using Kinds = std::map<std::pair<std::uint32_t, std::uint32_t>, Meeting>;

Kinds kinds_of(const Soup& s) {
    Kinds found;
    for (const auto& p : intersections(s.vertices, s.triangles)) found[{p.a, p.b}] = p.how.kind;
    return found;
}

TEST(MeetingEverywhere, SoupsAtIntegersMeetAsFractionsSay) {
    std::map<Meeting, int> seen;
    for (unsigned seed = 0; seed < test::seeds(3000); ++seed) {
        const Soup s = lattice_soup(seed);
        Kinds expected;
        for (std::uint32_t a = 0; a < s.triangles.size(); ++a) {
            for (std::uint32_t b = a + 1; b < s.triangles.size(); ++b) {
                if (is_degenerate(s, s.triangles[a]) || is_degenerate(s, s.triangles[b])) continue;
                const auto exact = test::exact_meeting(s.vertices, s.triangles[a], s.triangles[b]);
                if (exact.kind == Meeting::none) continue;
                expected[{a, b}] = exact.kind;
                ++seen[exact.kind];
            }
        }
        ASSERT_EQ(kinds_of(s), expected) << "seed " << seed;
    }
    for (const Meeting kind : {Meeting::point, Meeting::touch, Meeting::crossing, Meeting::overlap}) EXPECT_GT(seen[kind], 1000);
}

/// Exactly the same soup elsewhere: sheared by integers, scaled by a power of two, moved by what keeps all digits.
Soup moved(const Soup& s, int exponent, const Vec3& offset) {
    Soup m = s;
    for (Vec3& p : m.vertices) {
        p = {3 * p[0] + p[1] - p[2], p[0] - 5 * p[1] + 2 * p[2], 2 * p[0] + p[1] + 7 * p[2]};
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::ldexp(offset[k] + p[k], exponent);
    }
    return m;
}

TEST(MeetingEverywhere, SizeAndPlaceDoNotMatter) {
    for (unsigned seed = 0; seed < test::seeds(600); ++seed) {
        const Soup s = lattice_soup(seed);
        const Kinds expected = kinds_of(s);
        for (const int exponent : {-120, -40, 0, 40, 60}) ASSERT_EQ(kinds_of(moved(s, exponent, {})), expected) << seed << ' ' << exponent;
        ASSERT_EQ(kinds_of(moved(s, 0, {451234, 6812345, -1200})), expected) << "seed " << seed;
        ASSERT_EQ(kinds_of(moved(s, -3, {451234, 6812345, -1200})), expected) << "seed " << seed;
        ASSERT_EQ(kinds_of(moved(s, 0, {1e15, -1e15, 1e15})), expected) << "seed " << seed;
    }
}

TEST(MeetingEverywhere, OrderDoesNotMatter) {
    for (unsigned seed = 0; seed < test::seeds(600); ++seed) {
        std::mt19937 random(seed);
        const Soup s = lattice_soup(seed);
        std::vector<std::uint32_t> rename(s.vertices.size()), order(s.triangles.size());
        for (std::uint32_t i = 0; i < rename.size(); ++i) rename[i] = i;
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::shuffle(rename.begin(), rename.end(), random);
        std::shuffle(order.begin(), order.end(), random);
        Soup other;
        other.vertices.resize(s.vertices.size());
        for (std::size_t v = 0; v < rename.size(); ++v) other.vertices[rename[v]] = s.vertices[v];
        for (const std::uint32_t t : order) {
            Triangle corners{rename[s.triangles[t][0]], rename[s.triangles[t][1]], rename[s.triangles[t][2]]};
            std::shuffle(corners.begin(), corners.end(), random);
            other.triangles.push_back(corners);
        }
        Kinds found;
        for (const auto& [pair, kind] : kinds_of(other)) {
            const auto [a, b] = std::minmax(order[pair.first], order[pair.second]);
            found[{a, b}] = kind;
        }
        ASSERT_EQ(found, kinds_of(s)) << "seed " << seed;
    }
}

// Nearly degenerate: lattice soups flattened until their triangles are needles and slivers; all that is flat stays flat.
TEST(MeetingEverywhere, NearlyFlatSoupsMeetAsThoseThatAreNot) {
    for (unsigned seed = 0; seed < test::seeds(600); ++seed) {
        const Soup s = lattice_soup(seed);
        for (const int flatter : {20, 60, 100}) {
            Soup flat = s;
            for (Vec3& p : flat.vertices) p = {p[0], std::ldexp(p[1], -flatter / 2), std::ldexp(p[2], -flatter)};
            ASSERT_EQ(kinds_of(flat), kinds_of(s)) << "seed " << seed << ", " << flatter;
        }
    }
}

/// Segments of what the two have in common, both ends, in fractions; in any order.
bool has_ends(const std::array<Vec3, 2>& segment, const std::vector<test::Point>& points) {
    return std::ranges::all_of(points, [&](const test::Point& p) {
        return std::ranges::any_of(segment, [&](const Vec3& end) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (std::abs(end[k] - double(p[k].n) / double(p[k].d)) > 1e-12) return false;
            }
            return true;
        });
    });
}

TEST(MeetingEverywhere, SegmentsHaveTheirEndsInPlaceAndAreTheSameForBothOrders) {
    int segments = 0;
    for (unsigned seed = 0; seed < test::seeds(2000); ++seed) {
        const Soup s = lattice_soup(seed);
        for (const auto& pair : intersections(s.vertices, s.triangles)) {
            const Triangle &a = s.triangles[pair.a], &b = s.triangles[pair.b];
            const TriangleMeeting turned = meeting(s.vertices, b, a);
            ASSERT_EQ(turned.kind, pair.how.kind);
            if (pair.how.kind == Meeting::overlap) continue;
            const auto sorted = [](std::array<Vec3, 2> ends) {
                std::sort(ends.begin(), ends.end());
                return ends;
            };
            ASSERT_EQ(sorted(turned.segment), sorted(pair.how.segment)) << "seed " << seed << ", to the bit";
            const auto exact = test::exact_meeting(s.vertices, a, b);
            ASSERT_TRUE(has_ends(pair.how.segment, exact.points)) << "seed " << seed;
            ++segments;
        }
    }
    EXPECT_GT(segments, 5000);
}

}  // namespace
}  // namespace geomend
