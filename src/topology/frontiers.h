// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/brep.h"
#include "topology/line_graph.h"

namespace geomend::topology {

/// Regions found by walking along surfaces.
struct FoundRegions {
    std::vector<std::vector<BrepData::Side>> regions;  ///< ordered by their lowest side
    std::vector<BrepData::Side> universe;
    std::vector<LineId> uncertain_lines;  ///< two polygons coincide there, so their order around the line is not known
    /// Per side (2 x surface, + 1 for its front) the region that it bounds, or no_index for the Universe.
    std::vector<std::uint32_t> region_of_side;
    /// Two sides that face each other around a line; of the same surface where nothing else ends there.
    struct Join {
        std::uint32_t first, second, line;
    };
    std::vector<Join> joins;
};

/// Finds the regions that surfaces bound: around each line the surfaces are put in order (exactly, at its longest
/// edge) and each side is joined to the one that faces it; sides that hang together make a shell. A shell that encloses
/// a positive volume bounds a region; any other lies inside the smallest region that contains it, or in the Universe.
/// \param tolerances per surface; empty: 0. Polygons at a line that are no farther apart than the largest of their surfaces
/// coincide: their order is not known, and regions end there
/// Cost: near-linear; n log n where surfaces do not all hang together.
FoundRegions find_regions(const BrepData& brep, const LineGraph& graph, std::span<const double> cones,
                          std::span<const double> tolerances = {});

}  // namespace geomend::topology
