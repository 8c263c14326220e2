// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/objects.h"
#include "repair/soup_edges.h"

namespace geomend::repair {

/// A free edge of a patch, as its triangle is wound.
struct BorderEdge {
    std::uint32_t from, to;  ///< vertices
    std::uint32_t triangle;
    Vec3 outward;  ///< unit, in the plane of the triangle, away from it
    std::uint32_t piece = 0;
    std::uint32_t next = no_index, previous = no_index;  ///< border edges that follow on at `to` and come before at `from`
};

/// The free borders of a soup, in pieces that end at corners: where a border turns by more than 40 degrees, and where it parts.
struct FreeBorders {
    std::vector<BorderEdge> edges;
    std::vector<std::vector<std::uint32_t>> pieces;  ///< edges of each, in their order
};

/// Edges of triangles without area are left out. n log n.
FreeBorders free_borders(const TriangleSoup& soup, const SoupEdges& edges);

}  // namespace geomend::repair
