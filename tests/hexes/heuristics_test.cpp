// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/heuristics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <string_view>
#include <vector>

#include "hexes/cotree.h"
#include "hexes/lattice_meshes.h"
#include "hexes/local_search.h"
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

std::uint64_t edges_of(const Graph& graph) {
    std::uint64_t ends = 0;
    for (const auto& neighbours : graph) ends += neighbours.size();
    return ends / 2;
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

// Botella 2016, figure 3.11.
TEST(Cotree, KnowsTheHeaviestSetsOfAPublishedCograph) {
    using Set = std::vector<std::uint32_t>;
    // Join(Union(1, 5), Union(Join(0, 2), Union(3, 4)))
    Graph graph(6);
    for (const std::uint32_t one : {1u, 5u}) {
        for (const std::uint32_t other : {0u, 2u, 3u, 4u}) join(graph, one, other);
    }
    join(graph, 0, 2);
    EXPECT_EQ(edges_of(graph), 9u);
    const std::vector<double> even(6, 1);
    const Set apart = selected_of(graph, even, false);
    EXPECT_TRUE(apart == (Set{0, 3, 4}) || apart == (Set{2, 3, 4}));
    EXPECT_EQ(heaviest_of_all(graph, even), 3);
    // Its largest clique is what is apart in its complement, which is built as such and as a graph of its own.
    Graph other(6);
    for (std::uint32_t v = 0; v < 6; ++v) {
        for (std::uint32_t w = 0; w < 6; ++w) {
            if (v != w && !has(graph[v], w)) other[v].push_back(w);
        }
    }
    for (const bool complement : {false, true}) {
        const Set clique = selected_of(other, even, complement);
        ASSERT_EQ(clique.size(), 3u);
        for (const std::uint32_t v : clique) {
            for (const std::uint32_t w : clique) EXPECT_TRUE(v == w || has(graph[v], w));
        }
        EXPECT_TRUE(has(clique, 0) && has(clique, 2) && (has(clique, 1) || has(clique, 5)));
    }
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

struct PublishedGraph {
    std::uint32_t nodes;
    std::uint64_t edges, added;
    double percent;
    std::uint64_t complement_edges, complement_added;
    double complement_percent;
};

/// Botella 2016, tables 3.3 and 3.4.
constexpr PublishedGraph published_graphs[]{{3758, 88999, 2122342, 96.0, 6970404, 75356, 1.1},
                                            {3498, 74453, 2066124, 96.5, 6041800, 65592, 1.1},
                                            {6731, 244547, 8195475, 97.1, 22405268, 222380, 1.0},
                                            {8214, 323548, 13235864, 97.6, 33407243, 294061, 0.9}};

/// Of all edges of a graph in percent.
double percent_added(std::uint64_t own, std::uint64_t added) { return 100 * static_cast<double>(added) / static_cast<double>(own + added); }

/// A cograph: the first vertices have no edges; each later one has edges to all before it, or to none, so that there are as many as asked.
Graph graph_of(std::uint32_t nodes, std::uint64_t edges) {
    Graph graph(nodes);
    for (std::uint32_t v = nodes; v-- > 0;) {
        if (v > edges) continue;
        edges -= v;
        for (std::uint32_t w = 0; w < v; ++w) join(graph, v, w);
    }
    return graph;
}

TEST(Cotree, CountsEdgesOfGraphsAndTheirComplementsAsWasPublished) {
    for (const PublishedGraph& g : published_graphs) {
        const Graph graph = graph_of(g.nodes, g.edges);
        EXPECT_EQ(tree_of(graph, false).edge_count(), g.edges);
        EXPECT_EQ(tree_of(graph, true).edge_count(), g.complement_edges);
        EXPECT_NEAR(percent_added(g.edges, g.added), g.percent, 0.05);
        EXPECT_NEAR(percent_added(g.complement_edges, g.complement_added), g.complement_percent, 0.05);
    }
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
    EXPECT_GT(percent_added(edges, tree_of(graph, false).edge_count() - edges), 50);
    EXPECT_LT(percent_added(pairs - edges, tree_of(graph, true).edge_count() - (pairs - edges)), 20);
}

struct BrickCandidates {
    TetMesh tets;
    Candidates hexahedra, prisms, pyramids;
};

BrickCandidates candidates_of(const test::Lattice& l, double least_quality) {
    const auto mesh = VolumeMesh::make(test::mesh_data(l.points, test::kuhn_tets(l)));
    EXPECT_TRUE(mesh);
    BrickCandidates b;
    b.tets = tet_mesh_of(*mesh);
    const QuadTable quads(b.tets, least_quality);
    const SearchOptions search{least_quality, {}, nullptr};
    b.hexahedra = find_hexahedra(b.tets, quads, search);
    b.prisms = find_prisms(b.tets, quads, search);
    b.pyramids = find_pyramids(b.tets, quads, search);
    return b;
}

Candidates all_candidates_of(const BrickCandidates& b) {
    Candidates all = b.hexahedra;
    all.append(b.prisms);
    all.append(b.pyramids);
    return all;
}

void expect_apart(const Candidates& all, const std::vector<std::uint32_t>& selected, std::string_view name) {
    for (const std::uint32_t a : selected) {
        for (const std::uint32_t b : selected) EXPECT_TRUE(a == b || stand_together(all, a, b)) << name;
    }
}

TEST(Heuristics, TakeOfABrickWhatIsKnown) {
    const BrickCandidates brick = candidates_of(test::lattice({2, 2, 2}), 0.01);
    const Candidates all = all_candidates_of(brick);
    const Conflicts conflicts(all, brick.tets.tets.size());
    const std::vector<double> weights = weights_by_angles(brick.tets, all);
    for (const std::string_view name : heuristic_names) {
        const auto rule = heuristic_named(name);
        ASSERT_TRUE(rule);
        if (*rule == Heuristic::search) continue;
        const auto selected = select_by(*rule, brick.tets, conflicts, weights);
        const double weight = weight_of(selected, weights);
        expect_apart(all, selected, name);
        if (name == "GMax1" || name == "GMax2" || name == "GMax3") {
            EXPECT_NEAR(weight, 88, 1e-9) << name;
            EXPECT_EQ(selected.size(), 8u) << name;
        } else {
            EXPECT_LE(weight, 88 + 1e-9) << name;
        }
        if (name == "GMax4") {
            EXPECT_LT(weight, 60);
        }
        EXPECT_GT(weight, 20) << name;
    }
    EXPECT_FALSE(heuristic_named("GMax5"));
}

// Of the 38 hexahedra with flat faces eight are cubes; the others lean.
TEST(Heuristics, WeighHexahedraOfABrickAsIsKnown) {
    const BrickCandidates brick = candidates_of(test::lattice({2, 2, 2}), 1e-3);
    std::map<int, int> by_sine;  // in units of 1e-4
    for (const double w : weights_by_angles(brick.tets, brick.hexahedra)) ++by_sine[static_cast<int>(std::lround((w - 10) * 1e4))];
    EXPECT_EQ(by_sine[10000], 8);
    EXPECT_EQ(by_sine[9024], 24);
    EXPECT_EQ(by_sine[8777], 6);
}

/// \return the greatest weight of candidates that stand together, of those from `next` on. \pre 32 at most
double best_of_few(const std::vector<std::uint32_t>& in_way, const std::vector<double>& weights, std::size_t next, std::uint32_t out) {
    if (next == weights.size()) return 0;
    const double without = best_of_few(in_way, weights, next + 1, out);
    if ((out >> next & 1u) != 0) return without;
    return std::max(without, weights[next] + best_of_few(in_way, weights, next + 1, out | in_way[next]));
}

TEST(Heuristics, NeverTakeMoreThanTheBestOfTwentyAndNothingThatIsInConflict) {
    test::Lattice l = test::lattice({2, 2, 2});
    test::jitter(l, 0.2);
    const BrickCandidates brick = candidates_of(l, 0.01);
    const Candidates all = all_candidates_of(brick);
    Random random(5);
    std::map<std::string_view, int> best_found;
    for (int round = 0; round < 40; ++round) {
        std::vector<std::uint8_t> kept(all.size(), 0);
        for (int count = 0; count < 20;) {
            auto& one = kept[random.below(static_cast<std::uint32_t>(all.size()))];
            count += one == 0 ? 1 : 0;
            one = 1;
        }
        Candidates some = all;
        some.keep(kept);
        std::vector<std::uint32_t> in_way(some.size(), 0);
        for (std::uint32_t a = 0; a < some.size(); ++a) {
            for (std::uint32_t b = 0; b < some.size(); ++b) {
                if (a != b && !stand_together(some, a, b)) in_way[a] |= 1u << b;
            }
        }
        const std::vector<double> weights = weights_by_angles(brick.tets, some);
        const double best = best_of_few(in_way, weights, 0, 0);
        const Conflicts conflicts(some, brick.tets.tets.size());
        for (std::size_t rule = 1; rule < heuristic_names.size(); ++rule) {
            const auto selected = select_by(static_cast<Heuristic>(rule), brick.tets, conflicts, weights);
            expect_apart(some, selected, heuristic_names[rule]);
            const double weight = weight_of(selected, weights);
            EXPECT_LE(weight, best + 1e-9) << heuristic_names[rule];
            if (weight > best - 1e-9) ++best_found[heuristic_names[rule]];
        }
    }
    EXPECT_GT(best_found["GMax1"], 20);  // of 40
}

// Botella 2016, 3.4.4: the weights are such that a hexahedron is worth more than the prisms it may be parted into.
TEST(Heuristics, FourHexahedraBeatEightPrisms) {
    BrickCandidates brick = candidates_of(test::lattice({2, 2, 1}), 0.5);
    // The cubes themselves, and of each two prisms that are its halves.
    std::vector<std::uint8_t> is_cube;
    for (const double quality : brick.hexahedra.quality) is_cube.push_back(quality > 0.99 ? 1 : 0);
    brick.hexahedra.keep(is_cube);
    ASSERT_EQ(brick.hexahedra.size(), 4u);
    Candidates halves = brick.prisms;
    std::vector<std::uint8_t> kept(halves.size(), 0), tet_is_in(brick.tets.tets.size(), 0);
    const auto is_of_one_cube = [&](std::uint32_t prism) {
        for (std::uint32_t h = 0; h < 4; ++h) {
            const auto cube = brick.hexahedra.tets_of(h);
            if (std::ranges::all_of(halves.tets_of(prism), [&](auto t) { return std::ranges::find(cube, t) != cube.end(); })) return true;
        }
        return false;
    };
    for (std::uint32_t i = 0; i < halves.size(); ++i) {
        const auto own = halves.tets_of(i);
        if (!is_of_one_cube(i) || std::ranges::any_of(own, [&](auto t) { return tet_is_in[t] != 0; })) continue;
        kept[i] = 1;
        for (const auto t : own) tet_is_in[t] = 1;
    }
    halves.keep(kept);
    ASSERT_EQ(halves.size(), 8u);
    Candidates all = halves;
    all.append(brick.hexahedra);
    const std::vector<double> weights = weights_by_angles(brick.tets, all);
    double of_prisms = 0, of_hexahedra = 0;
    for (std::size_t i = 0; i < all.size(); ++i) (i < 8 ? of_prisms : of_hexahedra) += weights[i];
    EXPECT_LE(of_prisms, 40 + 1e-9);
    EXPECT_GE(of_hexahedra, 40);
    EXPECT_GT(of_hexahedra, of_prisms);
    const Conflicts conflicts(all, brick.tets.tets.size());
    const std::vector<std::uint32_t> hexahedra{8, 9, 10, 11};
    for (std::size_t rule = 1; rule < heuristic_names.size(); ++rule)
        EXPECT_EQ(select_by(static_cast<Heuristic>(rule), brick.tets, conflicts, weights), hexahedra) << heuristic_names[rule];
    std::vector<std::uint32_t> eight(8);
    std::iota(eight.begin(), eight.end(), 0u);
    LocalSearch how;
    how.steps = 10000;
    EXPECT_EQ(search_selection(conflicts, weights, eight, how), hexahedra);
}

}  // namespace
}  // namespace geomend::hexes
