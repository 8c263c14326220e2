// SPDX-License-Identifier: AGPL-3.0-or-later
// N. Euler's acceptance tests of cutting, by the numbers of the thesis' digest: 7, 15 to 17, 21, 25.
#include <gtest/gtest.h>

#include "arrangement/search.h"
#include "base/disjoint_sets.h"
#include "cut_soups.h"
#include "soup_of.h"

namespace geomend::test {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// Of each edge the triangles at it.
std::map<Edge, std::vector<std::uint32_t>> edges_of(const TriangleSoup& soup) {
    std::map<Edge, std::vector<std::uint32_t>> edges;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(soup.triangles[t][i], soup.triangles[t][(i + 1) % 3]);
            edges[{low, high}].push_back(t);
        }
    }
    return edges;
}

/// Edges that triangles of at least two patches have: the lines of the cut.
std::vector<Edge> line_edges(const TriangleSoup& soup) {
    std::vector<Edge> lines;
    for (const auto& [edge, at] : edges_of(soup)) {
        if (std::ranges::any_of(at, [&](std::uint32_t t) { return soup.patches[t] != soup.patches[at[0]]; })) lines.push_back(edge);
    }
    return lines;
}

/// Per vertex the patches that have it, ascending.
std::vector<std::set<std::uint32_t>> patches_at(const TriangleSoup& soup) {
    std::vector<std::set<std::uint32_t>> patches(soup.vertices.size());
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (const std::uint32_t v : soup.triangles[t]) patches[v].insert(soup.patches[t]);
    }
    return patches;
}

/// The parts of a patch between the lines of the cut: Euler's faces.
std::size_t faces_of(const TriangleSoup& soup, std::uint32_t patch) {
    DisjointSets same(soup.triangles.size());
    std::size_t faces = static_cast<std::size_t>(std::ranges::count(soup.patches, patch));
    for (const auto& [edge, at] : edges_of(soup)) {
        if (at.size() != 2 || soup.patches[at[0]] != patch || soup.patches[at[1]] != patch || same.root(at[0]) == same.root(at[1]))
            continue;
        same.join(at[0], at[1]);
        --faces;
    }
    return faces;
}

TEST(Euler7, CrossingSquaresShareALineOfFourNodesAndFallIntoTwoFacesEach) {
    TriangleSoup soup;
    add_patch(soup, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    add_patch(soup, {{0.3, -1, -1}, {0.3, 1, -1}, {0.3, 1, 1}, {0.3, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    const auto cut = expect_arranged(soup, 1e-7);
    const auto lines = line_edges(cut.soup);
    ASSERT_EQ(lines.size(), 3u);
    const auto edges = edges_of(cut.soup);
    std::set<double> nodes;
    for (const Edge& edge : lines) {
        EXPECT_EQ(edges.at(edge).size(), 4u) << "a radial group of four";
        for (const std::uint32_t v : edge) {
            nodes.insert(cut.soup.vertices[v][1]);
            EXPECT_NEAR(cut.soup.vertices[v][0], 0.3, 1e-9);
            EXPECT_EQ(cut.soup.vertices[v][2], 0);
        }
    }
    ASSERT_EQ(nodes.size(), 4u);
    const std::array<double, 4> expected{-1, 0, 0.3, 1};
    EXPECT_TRUE(std::ranges::equal(nodes, expected, [](double a, double b) { return std::abs(a - b) < 1e-9; }));
    for (const std::uint32_t patch : {0u, 1u}) {
        EXPECT_EQ(std::ranges::count(cut.soup.patches, patch), 8);
        EXPECT_EQ(faces_of(cut.soup, patch), 2u);
    }
    EXPECT_NEAR(area_of(cut.soup), 8, 1e-12);
}

/// T0 in the plane z = 0, and T1 to T8 upright, over the segments of the thesis' figure 3-38. \param seven_from where T7 begins
TriangleSoup figure_3_38(const std::array<double, 2>& seven_from) {
    TriangleSoup soup = soup_of({{-20, -20, 0}, {20, -20, 0}, {0, 20, 0}}, {{0, 1, 2}});
    using Point = std::array<double, 2>;
    const std::array<std::array<Point, 2>, 8> segments{{{{{-4, -2}, {-3, 2}}},
                                                        {{{-6, 0.1}, {6, -0.2}}},
                                                        {{{-5, -5}, {-3, -7}}},
                                                        {{{-5, -7}, {-3, -5.5}}},
                                                        {{{8, -8}, {9, -6}}},
                                                        {{{1, -3}, {4, 4}}},
                                                        {{seven_from, {0.5, 5}}},
                                                        {{{-9, -9}, {-8, -12}}}}};
    for (const auto& [p, q] : segments)
        add_patch(soup, {{p[0], p[1], -3}, {q[0], q[1], -3}, {q[0], q[1], 4}, {p[0], p[1], 4}}, {{0, 1, 2}, {0, 2, 3}});
    return soup;
}

/// The patches at vertices of T0 where more than two meet.
std::multiset<std::set<std::uint32_t>> points_of_several(const TriangleSoup& soup) {
    std::multiset<std::set<std::uint32_t>> points;
    for (const auto& patches : patches_at(soup)) {
        if (patches.size() > 2 && patches.contains(0u)) points.insert(patches);
    }
    return points;
}

TEST(Euler15, SetsOfTrianglesGiveTheTriplePointsOnATriangle) {
    using Sets = std::multiset<std::set<std::uint32_t>>;
    const auto cut = expect_arranged(figure_3_38({5, -3}), 1e-7);
    EXPECT_EQ(points_of_several(cut.soup), (Sets{{0, 1, 2}, {0, 2, 6}, {0, 2, 7}, {0, 3, 4}, {0, 6, 7}}));
    // Where T7 goes through the point of T0, T2 and T6, the candidate {0, 2, 6, 7} is a quadruple point.
    // T2: y = 0.1 - 0.025 (x + 6); T6: y = -3 + 7/3 (x - 1).
    const double x = (3 + 7.0 / 3 - 0.05) / (7.0 / 3 + 0.025), y = 0.1 - 0.025 * (x + 6);
    const auto four = expect_arranged(figure_3_38({0.5 + 2 * (x - 0.5), 5 + 2 * (y - 5)}), 1e-7);
    EXPECT_EQ(points_of_several(four.soup), (Sets{{0, 1, 2}, {0, 2, 6, 7}, {0, 3, 4}}));
}

TEST(Euler16, FourSegmentsOfATriangleMeetInOneNodeAtWhichLinesEnd) {
    TriangleSoup soup = soup_of({{-4, -4, 0}, {4, -4, 0}, {0, 6, 0}}, {{0, 1, 2}});
    add_patch(soup, {{-1, 0.1, -1}, {1, 0.1, -1}, {1, 0.1, 1}, {-1, 0.1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    add_patch(soup, {{0.2, -1, -1}, {0.2, 1, -1}, {0.2, 1, 1}, {0.2, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    const auto cut = expect_arranged(soup, 1e-7);
    const auto patches = patches_at(cut.soup);
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t v = 0; v < patches.size(); ++v) {
        if (patches[v].size() == 3) nodes.push_back(v);
    }
    ASSERT_EQ(nodes.size(), 1u);
    std::size_t on_triangle = 0, all = 0;
    const auto edges = edges_of(cut.soup);
    for (const Edge& edge : line_edges(cut.soup)) {
        if (edge[0] != nodes[0] && edge[1] != nodes[0]) continue;
        ++all;
        on_triangle += std::ranges::any_of(edges.at(edge), [&](std::uint32_t t) { return cut.soup.patches[t] == 0; }) ? 1 : 0;
    }
    EXPECT_EQ(on_triangle, 4u);
    EXPECT_EQ(all, 6u);
}

TEST(Euler17, AnEdgePointHasOneKeyWhicheverTriangleSeesIt) {
    // Two triangles over one edge, turned alike or not, and one that the edge pierces.
    for (const Triangle& second : {Triangle{1, 0, 3}, Triangle{0, 1, 3}, Triangle{3, 1, 0}}) {
        const std::vector<Vec3> points{{0, 0, -64}, {0, 0, 64}, {64, 0, 0}, {-64, 8, 0}, {-32, -32, 3}, {32, -32, 3}, {0, 64, 3}};
        const std::vector<Triangle> triangles{{0, 1, 2}, second, {4, 5, 6}};
        const std::vector<std::uint8_t> is_new(3, 1);
        const auto found = arrangement::search(points, triangles, is_new, 0.25, nullptr);
        std::map<decltype(found.points[0].key()), std::vector<Vec3>> by_key;
        for (const auto& p : found.points) {
            if (p.pierces && p.edge == arrangement::Link(0, 1)) by_key[p.key()].push_back(p.position);
        }
        ASSERT_EQ(by_key.size(), 1u);
        EXPECT_EQ(by_key.begin()->second, (std::vector<Vec3>(2, Vec3{0, 0, 3})));
    }
}

TEST(Euler21, AllSurfacesAtABorderGainTheNodeThatEndsOnIt) {
    for (const bool by_place : {false, true}) {
        TriangleSoup soup;
        if (by_place) {
            for (const Vec3& out : {Vec3{1, 0, 0}, Vec3{-1, 1, 0}, Vec3{-1, -1, 0}})
                add_patch(soup, {{0, 0, -1}, {0, 0, 1}, out}, {{0, 1, 2}});
        } else {
            soup = soup_of({{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
        }
        add_patch(soup, {{0, 0, 0.3}, {1, 1, 0.2}, {1, 1, 0.5}}, {{0, 1, 2}});  // a horizon that ends there
        const auto cut = expect_arranged(soup, 1e-6);
        const auto patches = patches_at(cut.soup);
        std::size_t nodes = 0;
        for (std::uint32_t v = 0; v < patches.size(); ++v) {
            if (cut.soup.vertices[v] != Vec3{0, 0, 0.3}) continue;
            ++nodes;
            EXPECT_EQ(patches[v], (std::set<std::uint32_t>{0, 1, 2, 3}));
        }
        EXPECT_EQ(nodes, 1u);
    }
}

TEST(Euler25, PiecesOfABorderBecomeTheSameOnBothSides) {
    // One side has the border A B C, the other A C.
    const Vec3 a{0, 0, 0}, b{0.4, 0, 0}, c{1, 0, 0};
    TriangleSoup soup;
    add_patch(soup, {a, b, c, {0.5, 1, 0}}, {{0, 1, 3}, {1, 2, 3}});
    add_patch(soup, {a, c, {0.5, -1, 0.3}}, {{0, 1, 2}});
    const auto cut = expect_arranged(soup, 1e-7);
    std::set<std::array<Vec3, 2>> borders;
    for (const auto& [p, q] : line_edges(cut.soup)) {
        const Vec3 &one = cut.soup.vertices[p], &two = cut.soup.vertices[q];
        borders.insert(one < two ? std::array{one, two} : std::array{two, one});
    }
    EXPECT_EQ(borders, (std::set<std::array<Vec3, 2>>{{a, b}, {b, c}}));
    EXPECT_EQ(cut.soup.triangles.size(), 4u);
}

}  // namespace
}  // namespace geomend::test
