// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/brep.h"
#include "topology/line_graph.h"

namespace geomend::topology {

/// Signed volume that some sides enclose, positive when they look inwards, and whether they close.
struct Enclosed {
    double volume = 0;
    bool closed = false;
    std::size_t singles = 0;         ///< sides whose opposite is not there, too
    std::vector<LineId> open_lines;  ///< along which they end without another one that goes on, ascending
};
Enclosed enclosed(std::span<const BrepData::Side> sides, std::span<const double> cones, const LineGraph& graph);

/// The sides of regions as a file states them, brought into agreement with the geometry.
struct SolvedSides {
    struct Region {
        std::vector<BrepData::Side> sides;
        Enclosed enclosed;
        std::vector<SurfaceId> turned;  ///< stated on the other side than the file's own convention would have it
    };
    std::vector<Region> regions;
    bool reversed_convention = false;  ///< throughout the file a sign means the other side
};

/// Derives which side of each of its surfaces a region lies on. Stated sides that close are right up to the sign
/// of the volume; where they do not close, neighbouring sides are turned until they do (across lines where just two
/// of the region's sides meet). Which of the two meanings of a sign the file uses is told by the majority.
/// Surfaces with both sides in one region are left alone.
/// \param stated per region; those of the Universe count as lying outside
/// \param universe which of them is the Universe, or no_index
SolvedSides solve_sides(const std::vector<std::vector<BrepData::Side>>& stated, std::uint32_t universe, std::span<const double> cones,
                        const LineGraph& graph);

}  // namespace geomend::topology
