// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridding/chains.h"

namespace geomend::gridding {

/// The pillars taken apart by chains: a pillar has a node for each group of columns around it that hang together without crossing a
/// chain there. Quadrant q of pillar (i,j) is the column (i-1,j-1), (i,j-1), (i-1,j), (i,j) for q = 0..3.
struct SplitPillars {
    static constexpr std::uint8_t no_column = 255;
    std::vector<std::uint32_t> first;      ///< first node of each pillar, and the number of nodes
    std::vector<std::uint8_t> node_of;     ///< four a pillar: which of its nodes the column of a quadrant uses; no_column: none is there
    std::vector<std::uint32_t> pillar_of;  ///< per node

    std::size_t node_count() const { return pillar_of.size(); }
    std::uint32_t node(std::size_t pillar, unsigned quadrant) const { return first[pillar] + node_of[4 * pillar + quadrant]; }
    bool is_split(std::size_t pillar) const { return first[pillar + 1] - first[pillar] > 1; }
};

/// Cost: linear.
SplitPillars split_pillars(const Net& net, const ChainEdges& edges);

/// The node that corner c of a column uses: c is 0 (I-,J-), 1 (I+,J-), 2 (I-,J+), 3 (I+,J+).
inline std::uint32_t corner_node(const Net& net, const SplitPillars& split, std::size_t i, std::size_t j, unsigned c) {
    return split.node(net.pillar(i + (c & 1u), j + (c >> 1)), 3 - c);
}

/// Which fault block each column is in, from 0: blocks are what hangs together without crossing a chain, numbered by their first
/// columns. Cost: linear.
struct Blocks {
    std::vector<std::uint32_t> of;  ///< per column
    std::uint32_t count = 0;
};
Blocks fault_blocks(const Net& net, const ChainEdges& edges);

/// The nodes that neighbour each one along an edge between pillars, on the same side of all chains.
struct NodeGraph {
    std::vector<std::uint64_t> first;  ///< per node, and the number of neighbours
    std::vector<std::uint32_t> next;
    std::span<const std::uint32_t> of(std::size_t node) const {
        return {next.data() + first[node], static_cast<std::size_t>(first[node + 1] - first[node])};
    }
};
NodeGraph node_graph(const Net& net, const SplitPillars& split);

}  // namespace geomend::gridding
