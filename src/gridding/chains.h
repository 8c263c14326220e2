// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gridding/net.h"
#include "model/objects.h"

namespace geomend::gridding {

/// A fault in the grid: a row of pillars, each next to the one before along I or J.
struct Chain {
    std::vector<std::uint32_t> pillars;            ///< empty: the fault is not in the grid
    Path trace;                                    ///< the part of the fault's trace within the grid, in the direction of the pillars
    double max_deviation = 0, mean_deviation = 0;  ///< from the trace, along the whole of the chain
    std::uint32_t shared_edges = 0;                ///< edges that a stronger fault's chain has taken
    std::vector<std::uint32_t> ends_on;            ///< faults on whose chains it was made to end
    std::string why_not;                           ///< why there is none
};

/// Which fault's chain an edge between pillars is on: no_fault or the number of the first fault there. Edge i of row j of `along_i` leads
/// from pillar (i,j) to (i+1,j) and is number i + nx j; edge j of `along_j` from (i,j) to (i,j+1), number i + (nx+1) j.
struct ChainEdges {
    static constexpr std::int32_t no_fault = -1;
    std::vector<std::int32_t> along_i, along_j;
};

struct Chains {
    std::vector<Chain> chains;  ///< one per trace
    ChainEdges edges;
};

/// Lays each trace on the edges between pillars by the shortest path, where an edge costs its length times one plus the square of the
/// distance of its middle from the trace in cells. Ends beyond the grid lie on its outline; an end nearer to another trace than half a
/// cell lies on that one's chain, which is then made before it; else longer traces come first. Chains do not share edges as far as they
/// can go beside each other. \param depth level at which pillars and traces are compared. Cost: pillars times traces, and
/// n log n in the pillars near each trace.
Chains make_chains(const Net& net, const std::vector<Path>& traces, double depth);

}  // namespace geomend::gridding
