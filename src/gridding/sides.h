// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/triangle_tree.h"
#include "gridding/split.h"
#include "gridding/structure.h"

namespace geomend::gridding {

/// On which side of a fault a node lies in the grid: +1 left of the direction of its chain, -1 right, 0 at its tip.
struct NearFault {
    std::uint32_t fault = 0;
    std::int8_t side = 0;
};

/// The faults near each node. Sides come from the chains alone: a node is on the side from which it is reached first.
struct NearFaults {
    std::vector<std::uint64_t> first;  ///< per node, and the number of all
    std::vector<NearFault> all;
    std::span<const NearFault> of(std::size_t node) const {
        return {all.data() + first[node], static_cast<std::size_t>(first[node + 1] - first[node])};
    }
};

/// \param reach per fault, how far from its trace it matters. \param depth the level of the traces
NearFaults near_faults(const Net& net, const SplitPillars& split, const NodeGraph& graph, const Chains& chains,
                       std::span<const double> reach, double depth);

/// On which side of a fault places of a model lie, by its surface where there is one, else by its lines. The fault outlives this.
class FaultSides {
public:
    explicit FaultSides(const Fault& fault);

    /// The lines go on straight beyond their first or last point: the fault does not end there, but what is known of it.
    void go_on(bool before_first, bool after_last) { goes_on_ = {before_first, after_last}; }

    /// +1 left of the trace's direction, -1 right; 0 beyond its ends or where it cannot be said. p is depth-down.
    int side(std::size_t horizon, const Vec3& p) const;
    /// Whether a place is within the ring around where a horizon is torn apart.
    bool is_torn(std::size_t horizon, const Point& p) const;
    /// How far the fault reaches from its trace in plan, between two depths.
    double reach(double upper, double lower) const;

private:
    struct Ring {
        Path points;
        Point low{}, high{};
    };
    const Fault& fault_;
    std::vector<Ring> rings_;   // per horizon
    std::vector<Path> traces_;  // per horizon, in the direction of the trace
    std::array<bool, 2> goes_on_{false, false};
    std::vector<Vec3> normals_;  // per triangle, of length 1
    std::optional<TriangleTree> tree_;
    int side_of_sheet(const Vec3& p) const;
};

}  // namespace geomend::gridding
