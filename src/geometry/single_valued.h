// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/vec3.h"
#include "geometry/triangle_pair.h"

namespace geomend {

/// Proves, for most surfaces of geological models, that their triangles meet each other in nothing but shared vertices and edges, without
/// looking at pairs of triangles: seen along x, y or z all turn the same way, and the border, seen so, is made of rings that neither
/// cross nor touch each other, of which none but one (or those beside each other) goes round from outside. A point in that view is
/// then covered as often as the border winds round it (the degree of the map), at most once.
/// \param triangles of the surface, over the vertices
/// \param open_edges its edges that are not known to have one triangle on each side that goes along them in opposite directions, from
/// vertex to vertex as their triangle has them; each use is one. \pre the others do have that
/// Returns true only where it is so, exactly; false means unknown. Cost: linear in the triangles, and about so in the open edges.
bool is_single_valued(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                      std::span<const std::array<std::uint32_t, 2>> open_edges);

}  // namespace geomend
