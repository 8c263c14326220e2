// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "exact_reference.h"
#include "geometry/predicates.h"
#include "support/seeds.h"

namespace geomend::test {

using Rational = boost::multiprecision::cpp_rational;

}  // namespace geomend::test

namespace geomend {
namespace {

using test::operator-;
using Exact = test::PointOf<test::Rational>;
using Common = test::CommonPartOf<test::Rational>;
using ExactTriangle = Common::Corners3;

Exact exact_point(const Vec3& v) { return {test::Rational(v[0]), test::Rational(v[1]), test::Rational(v[2])}; }
ExactTriangle exact_triangle(const std::vector<Vec3>& v, const Triangle& t) {
    return {exact_point(v[t[0]]), exact_point(v[t[1]]), exact_point(v[t[2]])};
}

/// The smallest feature that holds a point of the triangle.
TriangleFeature feature_of(const ExactTriangle& t, const Exact& p) {
    for (unsigned i = 0; i < 3; ++i) {
        if (t[i] == p) return corner_feature(i);
    }
    for (unsigned i = 0; i < 3; ++i) {
        if (Common::holds(t[i], t[(i + 1) % 3], p)) return edge_feature(i);
    }
    return TriangleFeature::face;
}

/// What contact() should say, from fractions: the kind, and the points with their features in no order.
struct Expected {
    Meeting kind = Meeting::none;
    std::vector<Exact> places;
    std::vector<ContactPoint> points;
};

Expected expected_contact(const ExactTriangle& p, const ExactTriangle& q, long shared) {
    const Common common(p, q);
    Expected found;
    const int dimension = common.dimension();
    if (dimension < 2 && dimension + 1 <= shared) return found;
    found.places = common.points();
    for (const Exact& x : found.places) found.points.push_back({feature_of(p, x), feature_of(q, x)});
    found.kind = dimension == 2 ? Meeting::overlap : dimension == 0 ? Meeting::point : Meeting::crossing;
    if (dimension != 1) return found;
    for (const ExactTriangle& t : {p, q}) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto on_edge = [&](const Exact& x) { return Common::holds(t[i], t[(i + 1) % 3], x); };
            if (std::all_of(found.places.begin(), found.places.end(), on_edge)) found.kind = Meeting::touch;
        }
    }
    return found;
}

long shared_numbers(const Triangle& a, const Triangle& b) {
    long shared = 0;
    for (const std::uint32_t v : a) shared += std::count(b.begin(), b.end(), v);
    return shared;
}

/// The place of each point that was found, or an empty list where the points are not those that were expected.
std::vector<Exact> places_in_order(const Contact& found, const Expected& expected) {
    std::vector<Exact> places;
    for (const ContactPoint& p : found.points()) {
        const auto at = std::find(expected.points.begin(), expected.points.end(), p);
        if (at == expected.points.end()) return {};
        places.push_back(expected.places[static_cast<std::size_t>(at - expected.points.begin())]);
    }
    return places;
}

Exact normal(const ExactTriangle& t) { return test::cross(Exact(t[1] - t[0]), Exact(t[2] - t[0])); }

/// Kind, points and direction against fractions.
void expect_right(const std::vector<Vec3>& v, const Triangle& a, const Triangle& b, const char* where) {
    const Contact found = contact(v, a, b);
    const ExactTriangle p = exact_triangle(v, a), q = exact_triangle(v, b);
    const Expected expected = expected_contact(p, q, shared_numbers(a, b));
    ASSERT_EQ(static_cast<int>(found.kind), static_cast<int>(expected.kind)) << where;
    ASSERT_EQ(found.count, expected.points.size()) << where;
    const std::vector<Exact> places = places_in_order(found, expected);
    ASSERT_EQ(places.size(), expected.points.size()) << where;
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) ASSERT_NE(places[i], places[j]) << where;
    }
    if (found.kind == Meeting::overlap) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Exact &x = places[i], &y = places[(i + 1) % places.size()], &z = places[(i + 2) % places.size()];
            const Exact turn = test::cross(Exact(y - x), Exact(z - x));
            ASSERT_GT(test::sign_of(test::Rational(test::dot(turn, normal(p)))), 0) << where << ": turns as a does, convex";
        }
    } else if (places.size() == 2) {
        const Exact along = test::cross(normal(p), normal(q));
        if (!test::is_zero(along)) {
            ASSERT_GT(test::sign_of(test::Rational(test::dot(along, Exact(places[1] - places[0])))), 0) << where;
        }
    }
}

constexpr std::array<std::array<unsigned, 3>, 6> orders{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

Triangle reordered(const Triangle& t, const std::array<unsigned, 3>& order) { return {t[order[0]], t[order[1]], t[order[2]]}; }

/// A feature of a reordered triangle as a feature of the triangle itself.
TriangleFeature in_the_first(TriangleFeature f, const std::array<unsigned, 3>& order) {
    if (f == TriangleFeature::face) return f;
    const unsigned i = order[index_of(f)], j = order[(index_of(f) + 1) % 3];
    return is_corner(f) ? corner_feature(i) : edge_feature((i + 1) % 3 == j ? i : j);
}

std::vector<std::pair<TriangleFeature, TriangleFeature>> sorted_points(const Contact& c, const std::array<unsigned, 3>& a,
                                                                       const std::array<unsigned, 3>& b, bool swapped) {
    std::vector<std::pair<TriangleFeature, TriangleFeature>> points;
    for (const ContactPoint& p : c.points()) {
        points.emplace_back(in_the_first(swapped ? p.on_b : p.on_a, a), in_the_first(swapped ? p.on_a : p.on_b, b));
    }
    std::sort(points.begin(), points.end());
    return points;
}

/// All orders of corners and of the two triangles give the same points.
void expect_the_same_in_all_orders(const std::vector<Vec3>& v, const Triangle& a, const Triangle& b, const char* where) {
    const Contact first = contact(v, a, b);
    const auto points = sorted_points(first, orders[0], orders[0], false);
    for (const auto& i : orders) {
        for (const auto& j : orders) {
            for (const bool swapped : {false, true}) {
                const Triangle p = reordered(a, i), q = reordered(b, j);
                const Contact again = swapped ? contact(v, q, p) : contact(v, p, q);
                ASSERT_EQ(static_cast<int>(again.kind), static_cast<int>(first.kind)) << where;
                ASSERT_EQ(sorted_points(again, i, j, swapped), points) << where;
            }
        }
    }
}

const Triangle one{0, 1, 2}, two{3, 4, 5};

bool are_triangles(const std::vector<Vec3>& v, const Triangle& b) {
    return !in_line(v[0], v[1], v[2]) && !in_line(v[b[0]], v[b[1]], v[b[2]]);
}

/// Counts what was tried, by kind and number of points, so that a test knows that it saw everything.
using Tally = std::array<std::array<int, 7>, 5>;
void count(Tally& tally, const Contact& c) { ++tally[static_cast<std::size_t>(c.kind)][c.count]; }

TEST(Contact, NamesTheFeaturesThatMeet) {
    using F = TriangleFeature;
    const std::vector<Vec3> flat = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto against = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
        std::vector<Vec3> v = flat;
        v.insert(v.end(), {p, q, r});
        expect_the_same_in_all_orders(v, one, two, "plain");
        return contact(v, one, two);
    };
    const Contact pierced = against({1, 1, -1}, {1, 1, 1}, {2, 1, 1});
    EXPECT_EQ(pierced.kind, Meeting::crossing);
    EXPECT_EQ(pierced.corners[0], (ContactPoint{F::face, F::edge_2}));
    EXPECT_EQ(pierced.corners[1], (ContactPoint{F::face, F::edge_0}));
    const Contact tip = against({1, 0, 0}, {2, 1, 4}, {1, 2, 4});
    EXPECT_EQ(tip.kind, Meeting::point);
    EXPECT_EQ(tip.corners[0], (ContactPoint{F::edge_0, F::corner_0}));
    const Contact edges = against({2, 0, -1}, {2, 0, 1}, {2, -4, 0});
    EXPECT_EQ(edges.corners[0], (ContactPoint{F::edge_0, F::edge_0}));
    const Contact along = against({1, 0, 0}, {4, 0, 0}, {1, 1, 5});
    EXPECT_EQ(along.kind, Meeting::touch);
    EXPECT_EQ(along.count, 2);
    const Contact star = against({-1, 3, 0}, {3, -1, 0}, {3, 3, 0});
    EXPECT_EQ(star.kind, Meeting::overlap);
    EXPECT_EQ(star.count, 6);
    EXPECT_EQ(against({5, 5, 0}, {7, 5, 0}, {1, 1, 5}).count, 0);
}

// All corners at small integers: every degenerate position comes many times, with zero to two corners shared, in one plane or not.
TEST(Contact, AgreesWithFractionsOnALattice) {
    std::mt19937 random(21);
    Tally tally{};
    const int rounds = static_cast<int>(3000 * test::seeds(1));
    for (int round = 0; round < rounds && !testing::Test::HasFatalFailure(); ++round) {
        const int size = 1 + round % 5;
        std::uniform_int_distribution<int> any(0, size);
        const unsigned shared = static_cast<unsigned>(round / 5) % 3;
        const bool flat = round % 3 == 0;
        std::vector<Vec3> v;
        for (int i = 0; i < 6; ++i) v.push_back({double(any(random)), double(any(random)), flat ? 1.0 : double(any(random))});
        Triangle b = two;
        for (std::uint32_t i = 0; i < shared; ++i) b[i] = (i + static_cast<unsigned>(round)) % 3;
        if (!are_triangles(v, b)) continue;
        expect_right(v, one, b, "lattice");
        if (round % 10 == 0) expect_the_same_in_all_orders(v, one, b, "lattice");
        count(tally, contact(v, one, b));
    }
    EXPECT_GT(tally[static_cast<std::size_t>(Meeting::none)][0], 100);
    EXPECT_GT(tally[static_cast<std::size_t>(Meeting::point)][1], 100);
    EXPECT_GT(tally[static_cast<std::size_t>(Meeting::touch)][2], 100);
    EXPECT_GT(tally[static_cast<std::size_t>(Meeting::crossing)][2], 100);
    for (std::size_t n = 3; n <= 5; ++n) EXPECT_GT(tally[static_cast<std::size_t>(Meeting::overlap)][n], 3) << n;
}

// The lattice on a plane or space that is not along the axes, in map coordinates, and with one coordinate moved by the last bit.
TEST(Contact, AgreesWithFractionsWhereOneBitDecides) {
    std::mt19937 random(22);
    Tally tally{};
    const int rounds = static_cast<int>(3000 * test::seeds(1));
    for (int round = 0; round < rounds && !testing::Test::HasFatalFailure(); ++round) {
        std::uniform_int_distribution<int> any(0, 4);
        const bool flat = round % 2 == 0;
        const Vec3 offset = round % 4 < 2 ? Vec3{451234.5, 6812345.25, -1200.125} : Vec3{};
        std::vector<Vec3> v;
        for (int i = 0; i < 6; ++i) {
            const double x = any(random), y = any(random), z = flat ? 0 : any(random);
            v.push_back({offset[0] + 3 * x + y - z, offset[1] + x - 5 * y + 2 * z, offset[2] + 2 * x + y + 7 * z});
        }
        Triangle b = two;
        if (round % 3 == 0) b[0] = 1;
        if (round % 5 == 0) {
            double& moved = v[static_cast<std::size_t>(round) % 6][static_cast<std::size_t>(round / 7) % 3];
            moved = std::nextafter(moved, round % 2 == 0 ? 1e9 : -1e9);
        }
        if (!are_triangles(v, b)) continue;
        expect_right(v, one, b, "sheared");
        if (round % 10 == 0) expect_the_same_in_all_orders(v, one, b, "sheared");
        count(tally, contact(v, one, b));
    }
    for (const Meeting kind : {Meeting::none, Meeting::point, Meeting::touch, Meeting::crossing}) {
        int seen = 0;
        for (const int n : tally[static_cast<std::size_t>(kind)]) seen += n;
        EXPECT_GT(seen, 20) << static_cast<int>(kind);
    }
}

// Six-cornered overlaps need triangles that stick out of each other on all sides.
TEST(Contact, AgreesWithFractionsOnStars) {
    std::mt19937 random(23);
    std::uniform_int_distribution<int> wobble(-2, 2);
    Tally tally{};
    for (int round = 0; round < 1500 && !testing::Test::HasFatalFailure(); ++round) {
        const auto near = [&](double x, double y) {
            const double u = x + wobble(random), w = y + wobble(random);
            return Vec3{u, w, u + 2 * w};
        };
        std::vector<Vec3> v = {near(0, 0), near(12, 0), near(6, 10), near(6, -4), near(12, 7), near(0, 7)};
        const Triangle b = round % 2 == 0 ? Triangle{3, 4, 5} : Triangle{4, 3, 5};
        if (!are_triangles(v, b)) continue;
        expect_right(v, one, b, "star");
        if (round % 20 == 0) expect_the_same_in_all_orders(v, one, b, "star");
        count(tally, contact(v, one, b));
    }
    EXPECT_GT(tally[static_cast<std::size_t>(Meeting::overlap)][6], 500);
    EXPECT_GT(tally[static_cast<std::size_t>(Meeting::overlap)][5], 50);
}

TEST(Contact, AgreesWithFractionsInGeneralPosition) {
    std::mt19937 random(24);
    std::uniform_real_distribution<double> any(-1, 1);
    Tally tally{};
    for (int round = 0; round < 1500 && !testing::Test::HasFatalFailure(); ++round) {
        const double map = round % 2 == 0 ? 6812345.25 : 0, flat = round % 3 == 0 ? 1e-9 : 1;
        std::vector<Vec3> v;
        for (int i = 0; i < 6; ++i) v.push_back({any(random), map + any(random), flat * any(random)});
        Triangle b = two;
        if (round % 4 == 0) b[2] = 0;
        expect_right(v, one, b, "random");
        count(tally, contact(v, one, b));
    }
    EXPECT_GT(tally[static_cast<std::size_t>(Meeting::crossing)][2], 200);
}

TEST(Contact, TheSameTriangleTwiceOverlapsInItself) {
    const std::vector<Vec3> v = {{0, 0, 0}, {4, 0, 0}, {0, 4, 1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 1}};
    for (const auto& i : orders) {
        const Contact by_number = contact(v, one, reordered(one, i)), by_place = contact(v, one, reordered(two, i));
        EXPECT_EQ(by_number.kind, Meeting::overlap);
        EXPECT_EQ(by_number.count, 3);
        for (unsigned n = 0; n < 3; ++n) EXPECT_EQ(i[index_of(by_number.corners[n].on_b)], index_of(by_number.corners[n].on_a));
        EXPECT_EQ(sorted_points(by_number, orders[0], i, false), sorted_points(by_place, orders[0], i, false));
    }
}

}  // namespace
}  // namespace geomend
