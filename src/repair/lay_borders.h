// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "model/origin.h"
#include "model/triangle_soup.h"

namespace geomend::repair {

/// A soup whose borders lie on what they run along.
struct LaidBorders {
    TriangleSoup soup;  ///< triangles that got points on their border are in several pieces
    Origin origin;
    std::uint64_t moved = 0, made = 0;  ///< vertices of borders that were moved, and new ones
    std::uint64_t dropped = 0;          ///< slivers at borders that are gone
};

/// Moves the borders of patches onto other surfaces that lie within the tolerance of them, and nothing else: vertices of a border
/// go to the nearest vertex there, else onto the nearest edge or face, and a border gets a vertex where it passes an edge or
/// a vertex of the other; slivers at a border that are no higher than the tolerance go first. Then they have places in common, by which a
/// cut with a reach of no length joins them: the surface that a border ends on does not bend, so that nothing new comes near anything. A
/// vertex stays where it would turn a triangle that is no sliver. Cost: n log n in triangles and in borders.
LaidBorders lay_borders(const TriangleSoup& soup, double tolerance);

}  // namespace geomend::repair
