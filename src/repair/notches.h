// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "repair/border_pieces.h"

namespace geomend::repair {

/// A place where a patch has lost triangles at its border: a free border between two points at which it ends on something else, and the
/// edges of others along which it would end there.
struct Notch {
    std::uint32_t patch = 0;
    std::uint32_t source = 0;                ///< a triangle of the patch beside it
    std::vector<Triangle> triangles;         ///< that fill it, wound as the patch is; empty: it is too wide, or nothing closes it
    std::vector<std::uint32_t> free_border;  ///< vertices, in the order in which the patch is wound
};

/// Notches that edges of other patches close, found by their vertices alone: single missing triangles whatever their size, also where
/// others have more points along their sides; others where half the way around them is no longer than the limit of their patch. What fills
/// one goes on in the direction of the triangles beside it, within 60 degrees. Cost: n log n in edges, and in the edges around small
/// notches.
std::vector<Notch> notches_of(const TriangleSoup& soup, const SoupEdges& edges, const FreeBorders& borders,
                              const std::vector<double>& limits);

/// Triangles over a closed loop of vertices, wound as it runs: ears are cut off where the loop turns the right way, the sharpest first.
std::vector<Triangle> filled_loop(const TriangleSoup& soup, std::vector<std::uint32_t> loop);

}  // namespace geomend::repair
