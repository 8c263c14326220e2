// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/heuristics.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hexes/cotree.h"
#include "hexes/lattice_meshes.h"
#include "hexes/random.h"

namespace geomend::hexes {
namespace {

using Graph = std::vector<std::vector<std::uint32_t>>;

std::vector<std::uint32_t> selected_of(const Graph& graph, const std::vector<double>& weights, bool complement) {
    Cotree tree(graph.size(), complement);
    for (std::uint32_t v = 0; v < graph.size(); ++v) tree.insert(v, graph[v]);
    return tree.heaviest(weights);
}

bool has(const std::vector<std::uint32_t>& all, std::uint32_t one) { return std::ranges::find(all, one) != all.end(); }

double weight_of(const std::vector<std::uint32_t>& selected, const std::vector<double>& weights) {
    double sum = 0;
    for (const std::uint32_t v : selected) sum += weights[v];
    return sum;
}

/// Of all sets of vertices without an edge.
double heaviest_of_all(const Graph& graph, const std::vector<double>& weights) {
    double best = 0;
    for (std::uint32_t set = 0; set < 1u << graph.size(); ++set) {
        double sum = 0;
        bool fits = true;
        for (std::uint32_t v = 0; v < graph.size() && fits; ++v) {
            if ((set >> v & 1u) == 0) continue;
            sum += weights[v];
            fits = std::ranges::none_of(graph[v], [&](std::uint32_t w) { return (set >> w & 1u) != 0; });
        }
        if (fits) best = std::max(best, sum);
    }
    return best;
}

void join(Graph& graph, std::uint32_t v, std::uint32_t w) {
    graph[v].push_back(w);
    graph[w].push_back(v);
}

/// Each new vertex is a twin of one before: joined to it or not. All graphs of that kind are cographs.
Graph graph_of_twins(std::uint32_t count, Random& random) {
    Graph graph(count);
    for (std::uint32_t v = 1; v < count; ++v) {
        const std::uint32_t twin = random.below(v);
        const std::vector<std::uint32_t> neighbours = graph[twin];
        for (const std::uint32_t w : neighbours) join(graph, v, w);
        if (random.below(2) == 0) join(graph, v, twin);
    }
    return graph;
}

TEST(Cotree, KnowsTheHeaviestSetsOfAPublishedCograph) {
    // Join(Union(1, 5), Union(Join(0, 2), Union(3, 4)))
    Graph graph(6);
    for (const std::uint32_t one : {1u, 5u}) {
        for (const std::uint32_t other : {0u, 2u, 3u, 4u}) join(graph, one, other);
    }
    join(graph, 0, 2);
    EXPECT_EQ(weight_of(selected_of(graph, std::vector<double>(6, 1), false), std::vector<double>(6, 1)), 3);
    // As neighbours in the complement: the set of vertices that are all joined.
    Graph other(6);
    for (std::uint32_t v = 0; v < 6; ++v) {
        for (std::uint32_t w = 0; w < 6; ++w) {
            if (v != w && !has(graph[v], w)) other[v].push_back(w);
        }
    }
    EXPECT_EQ(weight_of(selected_of(other, std::vector<double>(6, 1), true), std::vector<double>(6, 1)), 3);
}

TEST(Cotree, IsExactForCographsInAnyOrderAndAsAComplement) {
    Random random(7);
    for (int round = 0; round < 400; ++round) {
        const std::uint32_t count = 2 + random.below(11);
        const Graph graph = graph_of_twins(count, random);
        std::vector<double> weights(count);
        for (double& w : weights) w = 1 + random.below(9);
        const double best = heaviest_of_all(graph, weights);
        EXPECT_EQ(weight_of(selected_of(graph, weights, false), weights), best);
        EXPECT_EQ(weight_of(selected_of(graph, weights, true), weights), best);
    }
}

TEST(Cotree, NeverTakesNeighboursOfAGraphThatIsNone) {
    Random random(11);
    for (int round = 0; round < 400; ++round) {
        const std::uint32_t count = 2 + random.below(12);
        Graph graph(count);
        for (std::uint32_t v = 0; v < count; ++v) {
            for (std::uint32_t w = 0; w < v; ++w) {
                if (random.below(3) == 0) join(graph, v, w);
            }
        }
        std::vector<double> weights(count);
        for (double& w : weights) w = 1 + random.below(9);
        const double best = heaviest_of_all(graph, weights);
        const auto selected = selected_of(graph, weights, false);
        for (const std::uint32_t v : selected) {
            for (const std::uint32_t w : selected) EXPECT_FALSE(has(graph[v], w));
        }
        EXPECT_LE(weight_of(selected, weights), best);
        // Of the complement edges were added: what it takes may hold neighbours, and weighs at least as much.
        EXPECT_GE(weight_of(selected_of(graph, weights, true), weights), best);
    }
}

std::uint64_t edges_of(const Graph& graph) {
    std::uint64_t ends = 0;
    for (const auto& neighbours : graph) ends += neighbours.size();
    return ends / 2;
}

Cotree tree_of(const Graph& graph, bool complement) {
    Cotree tree(graph.size(), complement);
    for (std::uint32_t v = 0; v < graph.size(); ++v) tree.insert(v, graph[v]);
    return tree;
}

TEST(Cotree, AddsNoEdgesToACographAndOneToAPathOfFour) {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        const std::uint32_t count = 2 + random.below(30);
        const Graph graph = graph_of_twins(count, random);
        EXPECT_EQ(tree_of(graph, false).edge_count(), edges_of(graph));
        EXPECT_EQ(tree_of(graph, true).edge_count(), count * (count - 1) / 2 - edges_of(graph));
    }
    Graph path(4);
    for (std::uint32_t v = 0; v < 3; ++v) join(path, v, v + 1);
    EXPECT_EQ(tree_of(path, false).edge_count(), 4u);
    EXPECT_EQ(tree_of(path, true).edge_count(), 4u);  // its complement is a path of four, too
}

// Botella 2016, tables 3.3 and 3.4: a graph of conflicts has as many edges as its complement has not, and to make it a cograph takes very
// many edges, some 96 of a hundred that it then has, while the complement takes few.
TEST(Cotree, AddsManyEdgesToConflictsAndFewToTheirComplement) {
    const test::Lattice l = test::lattice({3, 3, 3});
    const auto mesh = VolumeMesh::make(test::mesh_data(l.points, test::kuhn_tets(l)));
    ASSERT_TRUE(mesh);
    const TetMesh tets = tet_mesh_of(*mesh);
    const QuadTable quads(tets, 0.01);
    Candidates all = find_hexahedra(tets, quads, {0.01, {}, nullptr});
    all.append(find_prisms(tets, quads, {0.01, {}, nullptr}));
    all.append(find_pyramids(tets, quads, {0.01, {}, nullptr}));
    const Conflicts conflicts(all, tets.tets.size());
    Graph graph(all.size());
    std::vector<std::uint32_t> seen(all.size(), no_index);
    for (std::uint32_t v = 0; v < graph.size(); ++v) conflicts.visit(v, seen, v, [&](std::uint32_t w) { graph[v].push_back(w); });
    const std::uint64_t pairs = graph.size() * (graph.size() - 1) / 2, edges = edges_of(graph);
    EXPECT_EQ(edges, conflicts.count());
    const auto added = [](std::uint64_t with, std::uint64_t own) { return static_cast<double>(with - own) / static_cast<double>(with); };
    EXPECT_GT(added(tree_of(graph, false).edge_count(), edges), 0.5);
    EXPECT_LT(added(tree_of(graph, true).edge_count(), pairs - edges), 0.2);
}

TEST(Heuristics, TakeOfABrickWhatIsKnown) {
    const test::Lattice l = test::lattice({2, 2, 2});
    const auto mesh = VolumeMesh::make(test::mesh_data(l.points, test::kuhn_tets(l)));
    ASSERT_TRUE(mesh);
    const TetMesh tets = tet_mesh_of(*mesh);
    const QuadTable quads(tets, 0.01);
    const SearchOptions search{0.01, {}, nullptr};
    Candidates all = find_hexahedra(tets, quads, search);
    all.append(find_prisms(tets, quads, search));
    all.append(find_pyramids(tets, quads, search));
    const Conflicts conflicts(all, tets.tets.size());
    const std::vector<double> weights = weights_by_angles(tets, all);
    for (const std::string_view name : heuristic_names) {
        const auto rule = heuristic_named(name);
        ASSERT_TRUE(rule);
        if (*rule == Heuristic::search) continue;
        const auto selected = select_by(*rule, tets, conflicts, weights);
        const double weight = weight_of(selected, weights);
        for (const std::uint32_t a : selected) {
            for (const std::uint32_t b : selected) EXPECT_TRUE(a == b || stand_together(all, a, b)) << name;
        }
        if (name == "GMax1" || name == "GMax2" || name == "GMax3") EXPECT_NEAR(weight, 88, 1e-9) << name;
        else EXPECT_LE(weight, 88 + 1e-9) << name;
        EXPECT_GT(weight, 20) << name;
    }
    EXPECT_FALSE(heuristic_named("GMax5"));
}

}  // namespace
}  // namespace geomend::hexes
