// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/vectors.h"

namespace geomend {
namespace {

/// A square of two triangles, each a patch of its own, with its diagonal embedded.
TriangleSoup square() {
    TriangleSoup s;
    s.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    s.triangles = {{0, 1, 2}, {0, 2, 3}};
    s.patches = {0, 1};
    s.edges = {{0, 2}};
    s.edge_ids = {7};
    return s;
}

/// Each triangle split in three at a point inside, at random; the origin is that of the splitting.
TriangleSoup split_in_three(const TriangleSoup& from, Origin& origin, std::mt19937& random) {
    std::uniform_real_distribution<double> any(0.1, 1);
    TriangleSoup to;
    to.vertices = from.vertices;
    origin = identity_origin(from);
    origin.triangles.clear();
    for (std::uint32_t t = 0; t < from.triangles.size(); ++t) {
        const auto [a, b, c] = from.triangles[t];
        Weights w{any(random), any(random), any(random)};
        const double sum = w[0] + w[1] + w[2];
        for (double& x : w) x /= sum;
        const auto at = static_cast<std::uint32_t>(to.vertices.size());
        to.vertices.push_back(plus(plus(times(w[0], from.vertices[a]), times(w[1], from.vertices[b])), times(w[2], from.vertices[c])));
        origin.vertices.push_back(Origin::from_triangle(t, w));
        to.triangles.insert(to.triangles.end(), {{a, b, at}, {b, c, at}, {c, a, at}});
        to.patches.insert(to.patches.end(), 3, from.patches[t]);
        origin.triangles.insert(origin.triangles.end(), 3, t);
    }
    return to;
}

TEST(TriangleSoup, TakesWhatIsRight) {
    EXPECT_TRUE(check(TriangleSoup{}));
    EXPECT_TRUE(check(square()));
    TriangleSoup degenerate = square();
    degenerate.triangles[0] = {1, 1, 1};
    EXPECT_TRUE(check(degenerate)) << "judging triangles is not its matter";
}

TEST(TriangleSoup, RefusesWhatIsWrong) {
    const auto refused = [](auto spoil) {
        TriangleSoup s = square();
        spoil(s);
        return !check(s).ok();
    };
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.triangles[1][2] = 4; }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.triangles[1][0] = no_index; }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.vertices.pop_back(); }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.vertices[2][1] = std::numeric_limits<double>::quiet_NaN(); }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.vertices[2][1] = -std::numeric_limits<double>::infinity(); }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.patches.pop_back(); }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.patches.push_back(0); }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.edge_ids.clear(); }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.edges[0][1] = 4; }));
    EXPECT_TRUE(refused([](TriangleSoup& s) { s.edges[0][1] = 0; }));
}

TEST(Origin, RefusesWhatDoesNotFit) {
    std::mt19937 random(3);
    const TriangleSoup from = square();
    Origin right;
    const TriangleSoup to = split_in_three(from, right, random);
    ASSERT_TRUE(check(right, from, to));
    EXPECT_TRUE(check(identity_origin(from), from, from));
    const auto refused = [&](auto spoil) {
        Origin o = right;
        spoil(o);
        return !check(o, from, to).ok();
    };
    EXPECT_TRUE(refused([](Origin& o) { o.vertices.pop_back(); }));
    EXPECT_TRUE(refused([](Origin& o) { o.triangles.push_back(0); }));
    EXPECT_TRUE(refused([](Origin& o) { o.triangles[0] = 2; }));
    EXPECT_TRUE(refused([](Origin& o) { o.vertices[0].vertex = 4; }));
    EXPECT_TRUE(refused([](Origin& o) { o.vertices[4].triangle = 2; }));
    EXPECT_TRUE(refused([](Origin& o) { o.vertices[4].vertex = 0; })) << "two origins";
    EXPECT_TRUE(refused([](Origin& o) { o.vertices[0].weights = {1, 0, 0}; })) << "weights without a triangle";
    EXPECT_TRUE(refused([](Origin& o) { o.vertices[4].weights = {0.5, 0.5, 0.5}; }));
    EXPECT_TRUE(refused([](Origin& o) { o.vertices[4].weights = {1.5, -0.5, 0}; }));
    EXPECT_TRUE(refused([](Origin& o) { o.vertices[4].weights[0] = std::numeric_limits<double>::quiet_NaN(); }));
    Origin made = right;
    made.triangles[0] = no_index;
    made.vertices[4] = {};
    EXPECT_TRUE(check(made, from, to)) << "things made from nothing";
}

TEST(Origin, OfNothingDoneIsNeutral) {
    std::mt19937 random(4);
    const TriangleSoup from = square();
    Origin o;
    const TriangleSoup to = split_in_three(from, o, random);
    const Origin before = composed(identity_origin(from), o, from, from), after = composed(o, identity_origin(to), from, to);
    EXPECT_EQ(before.triangles, o.triangles);
    EXPECT_EQ(after.triangles, o.triangles);
    EXPECT_EQ(after.vertices, o.vertices) << "to the bit";
    EXPECT_EQ(before.vertices, o.vertices) << "to the bit";
}

// Split again and again: the origin of the whole still gives each position, and input vertices are themselves to the end.
TEST(Origin, OfStepAfterStepGivesThePositions) {
    std::mt19937 random(5);
    const TriangleSoup source = square();
    TriangleSoup now = source;
    Origin whole = identity_origin(source);
    for (int step = 0; step < 5; ++step) {
        Origin o;
        TriangleSoup next = split_in_three(now, o, random);
        ASSERT_TRUE(check(o, now, next));
        whole = composed(whole, o, source, now);
        now = std::move(next);
        ASSERT_TRUE(check(whole, source, now));
    }
    ASSERT_EQ(now.triangles.size(), 2u * 243);
    for (std::uint32_t v = 0; v < now.vertices.size(); ++v) {
        const Origin::Vertex& o = whole.vertices[v];
        if (v < 4) {
            EXPECT_EQ(o, Origin::from_vertex(v));
            continue;
        }
        ASSERT_NE(o.triangle, no_index);
        Vec3 p{};
        for (std::size_t i = 0; i < 3; ++i) p = plus(p, times(o.weights[i], source.vertices[source.triangles[o.triangle][i]]));
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p[k], now.vertices[v][k], 1e-12);
    }
    for (std::uint32_t t = 0; t < now.triangles.size(); ++t) EXPECT_EQ(source.patches[whole.triangles[t]], now.patches[t]);
}

TEST(Origin, OfThingsMadeFromNothingStaysNothing) {
    const TriangleSoup soup = square();
    Origin first = identity_origin(soup), second = identity_origin(soup);
    first.triangles[1] = no_index;
    first.vertices[3] = {};
    second.vertices[0] = Origin::from_triangle(1, {0.5, 0.25, 0.25});
    const Origin both = composed(first, second, soup, soup);
    EXPECT_EQ(both.triangles, (std::vector<std::uint32_t>{0, no_index}));
    EXPECT_EQ(both.vertices[3], Origin::Vertex{});
    EXPECT_EQ(both.vertices[0], Origin::Vertex{}) << "a point of a triangle made from nothing";
    EXPECT_TRUE(check(both, soup, soup));
}

// A vertex on the line between two triangles names one of them; its place in the other comes from where it is.
TEST(Origin, AVertexOnAContactHasAPlaceInEachTriangle) {
    const TriangleSoup source = square();
    TriangleSoup result = source;
    result.vertices.push_back({1, 1, 0});
    result.triangles = {{0, 1, 4}, {4, 1, 2}, {0, 4, 3}, {4, 2, 3}};
    result.patches = {0, 0, 1, 1};
    Origin o = identity_origin(source);
    o.vertices.push_back(Origin::from_triangle(0, {0.75, 0, 0.25}));
    o.triangles = {0, 0, 1, 1};
    ASSERT_TRUE(check(o, source, result));
    EXPECT_EQ(corner_weights(o, source, result, 0, 2), (Weights{0.75, 0, 0.25}));
    EXPECT_EQ(corner_weights(o, source, result, 0, 0), (Weights{1, 0, 0}));
    const Weights other = corner_weights(o, source, result, 2, 1);
    EXPECT_NEAR(other[0], 0.75, 1e-15);
    EXPECT_NEAR(other[1], 0.25, 1e-15);
    EXPECT_NEAR(other[2], 0, 1e-15);
}

TEST(Weights, GiveBackThePointAndItsNearestOne) {
    const Vec3 a{451000, 6812000, -1200}, b{451090, 6812010, -1210}, c{451020, 6812080, -1190};
    std::mt19937 random(6);
    std::uniform_real_distribution<double> any(-0.5, 1.5);
    for (int round = 0; round < 2000; ++round) {
        const double s = any(random), t = any(random);
        const Vec3 p = plus(a, plus(times(s, minus(b, a)), times(t, minus(c, a))));
        const Weights w = weights_in(a, b, c, p);
        for (const double x : w) ASSERT_TRUE(x >= 0 && x <= 1);
        ASSERT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
        if (s > 0 && t > 0 && s + t < 1) {
            ASSERT_NEAR(w[1], s, 1e-9);
            ASSERT_NEAR(w[2], t, 1e-9);
        } else {
            ASSERT_LT(std::min({w[0], w[1], w[2]}), 1e-9) << "on the border";
        }
    }
    EXPECT_EQ(weights_in(a, b, c, b), (Weights{0, 1, 0}));
    EXPECT_EQ(weights_in(a, b, c, plus(b, times(3, minus(b, plus(times(0.5, a), times(0.5, c)))))), (Weights{0, 1, 0}))
        << "beyond a corner";
    EXPECT_EQ(weights_in(a, a, a, b), (Weights{1, 0, 0})) << "a triangle that is a point";
    const Weights flat = weights_in({0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {3, 1, 0});
    EXPECT_NEAR(4 * flat[1] + 2 * flat[2], 3, 1e-12) << "a triangle that is a segment";
}

}  // namespace
}  // namespace geomend
