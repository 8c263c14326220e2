// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridding/sides.h"

namespace geomend::gridding {

/// Where the depth of a node comes from.
enum class DepthSource : std::uint8_t {
    read,      ///< the horizon there
    extended,  ///< the horizon on the node's own side of faults, continued to it
    filled     ///< the nearest node: the horizon has no value there, and the columns around are inactive
};

/// A horizon at all nodes.
struct NodeDepths {
    std::vector<double> depths;
    std::vector<DepthSource> sources;
    std::vector<std::uint32_t> repeated;  ///< nodes whose pillar meets the horizon more than once on the same side of all faults
};

/// What the depths of nodes are worked out from.
struct NodeSetting {
    const Net& net;
    const SplitPillars& split;
    const NodeGraph& graph;
    const NearFaults& near;
    std::span<const FaultSides> sides;  ///< per fault
    std::span<const double> reach;      ///< per fault, how far from its trace it matters
    double level = 0;                   ///< where leaning pillars are looked for first
    double cell = 1;                    ///< spacing of the pillars
};

/// Depths at nodes: the horizon itself where a node is away from faults, or where what lies there is on the node's side of them and not
/// torn. Else a plane through the nearest pieces on that side, weighted by their nearness, so that planes are met exactly. Never across a
/// fault. Cost: n log n; where horizons are continued, some 20 microseconds a node.
NodeDepths node_depths(const Structure& structure, std::size_t horizon, const NodeSetting& setting);

}  // namespace geomend::gridding
