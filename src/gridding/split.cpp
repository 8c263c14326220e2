// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/split.h"

#include <array>

#include "base/disjoint_sets.h"

namespace geomend::gridding {

namespace {

/// The chains around a pillar: edges to I-, I+, J-, J+.
struct Around {
    bool i_minus, i_plus, j_minus, j_plus;
};

Around around(const Net& net, const ChainEdges& edges, std::size_t i, std::size_t j) {
    const std::size_t nx = net.cells[0], ny = net.cells[1];
    const auto cut = [](std::int32_t fault) { return fault != ChainEdges::no_fault; };
    return {i > 0 && cut(edges.along_i[i - 1 + nx * j]), i < nx && cut(edges.along_i[i + nx * j]),
            j > 0 && cut(edges.along_j[i + (nx + 1) * (j - 1)]), j < ny && cut(edges.along_j[i + (nx + 1) * j])};
}

}  // namespace

SplitPillars split_pillars(const Net& net, const ChainEdges& edges) {
    const std::size_t nx = net.cells[0], ny = net.cells[1];
    SplitPillars split;
    split.first.reserve(net.pillar_count() + 1);
    split.node_of.reserve(4 * net.pillar_count());
    for (std::size_t j = 0; j <= ny; ++j) {
        for (std::size_t i = 0; i <= nx; ++i) {
            const std::array<bool, 4> there{i > 0 && j > 0, i < nx && j > 0, i > 0 && j < ny, i < nx && j < ny};
            const Around cut = around(net, edges, i, j);
            std::array<std::uint8_t, 4> group{0, 1, 2, 3};
            const auto join = [&](unsigned a, unsigned b, bool is_cut) {
                if (is_cut || !there[a] || !there[b]) return;
                const std::uint8_t from = group[b], to = group[a];
                for (std::uint8_t& g : group) g = g == from ? to : g;
            };
            join(0, 1, cut.j_minus);
            join(2, 3, cut.j_plus);
            join(0, 2, cut.i_minus);
            join(1, 3, cut.i_plus);
            std::array<std::uint8_t, 4> numbers{SplitPillars::no_column, SplitPillars::no_column, SplitPillars::no_column,
                                                SplitPillars::no_column};
            const auto pillar = static_cast<std::uint32_t>(split.first.size());
            split.first.push_back(static_cast<std::uint32_t>(split.pillar_of.size()));
            std::uint8_t count = 0;
            for (unsigned q = 0; q < 4; ++q) {
                if (there[q] && numbers[group[q]] == SplitPillars::no_column) {
                    numbers[group[q]] = count++;
                    split.pillar_of.push_back(pillar);
                }
                split.node_of.push_back(there[q] ? numbers[group[q]] : SplitPillars::no_column);
            }
        }
    }
    split.first.push_back(static_cast<std::uint32_t>(split.pillar_of.size()));
    return split;
}

Blocks fault_blocks(const Net& net, const ChainEdges& edges) {
    const std::size_t nx = net.cells[0], ny = net.cells[1];
    DisjointSets sets(net.column_count());
    for (std::size_t j = 0; j < ny; ++j) {
        for (std::size_t i = 0; i < nx; ++i) {
            const auto c = static_cast<std::uint32_t>(net.column(i, j));
            if (i > 0 && edges.along_j[i + (nx + 1) * j] == ChainEdges::no_fault) sets.join(c, c - 1);
            if (j > 0 && edges.along_i[i + nx * j] == ChainEdges::no_fault) sets.join(c, c - static_cast<std::uint32_t>(nx));
        }
    }
    Blocks blocks;
    blocks.of = std::move(sets).roots();
    for (std::uint32_t c = 0; c < blocks.of.size(); ++c) {
        // A root is the first column of its block.
        blocks.of[c] = blocks.of[c] == c ? blocks.count++ : blocks.of[blocks.of[c]];
    }
    return blocks;
}

NodeGraph node_graph(const Net& net, const SplitPillars& split) {
    const std::size_t row = std::size_t{net.cells[0]} + 1;
    // Seen from quadrant q of a pillar, the column there has its pillars along I and along J.
    constexpr std::array<std::array<int, 2>, 4> steps = {{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    constexpr std::array<unsigned, 4> across_i = {1, 0, 3, 2}, across_j = {2, 3, 0, 1};
    NodeGraph graph;
    graph.first.reserve(split.node_count() + 1);
    graph.first.push_back(0);
    for (std::uint32_t node = 0; node < split.node_count(); ++node) {
        const std::size_t p = split.pillar_of[node], begin = graph.next.size();
        const auto add = [&](std::uint32_t other) {
            for (std::size_t k = begin; k < graph.next.size(); ++k) {
                if (graph.next[k] == other) return;
            }
            graph.next.push_back(other);
        };
        for (unsigned q = 0; q < 4; ++q) {
            if (split.node_of[4 * p + q] == SplitPillars::no_column || split.node(p, q) != node) continue;
            add(split.node(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) + steps[q][0]), across_i[q]));
            add(split.node(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) + steps[q][1] * static_cast<std::ptrdiff_t>(row)),
                           across_j[q]));
        }
        graph.first.push_back(graph.next.size());
    }
    return graph;
}

}  // namespace geomend::gridding
