// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::editing {

/// What the triangles that take the place of others must keep to; lengths are in the unit of the coordinates.
struct RingRules {
    double distance = 0;  ///< the plane of no new triangle passes farther from the point that is taken away
    double flatness = 0;  ///< no new triangle is lower than this
};

/// A ring of vertices around a point, in the order in which its triangles turn.
struct Ring {
    std::vector<Vec3> places;
    std::vector<std::uint8_t> on_trace;  ///< per place 1 where the vertex is to be taken away, too
    bool closed = true;                  ///< false: the point is on a border, which afterwards runs from the last place to the first
};

/// Triangles, as places in the ring, that fill it where its point is taken away: those with the fewest ends of diagonals at vertices
/// that are to be taken away as well, so that the edge comes back that was there before a cut, and each of these vertices has a triangle
/// less than before (N. Euler's thesis, 2.3.4); of them the shortest diagonals together.
/// Nothing where the rules allow no filling, or the ring folds as seen along its normal. A triangle keeps the distance by its
/// plane: the old and the new surface have flat tetrahedra between them, so they are no farther from each other, also over a bend.
/// \param barred pairs of places between which no new edge may run, since there is one already
/// \pre at least three places, at most longest_ring. Cost: cube of the length of the ring.
std::optional<std::vector<std::array<std::uint32_t, 3>>> fill_ring(const Ring& ring, const Vec3& point, const RingRules& rules,
                                                                   const std::function<bool(std::uint32_t, std::uint32_t)>& barred);
inline constexpr std::size_t longest_ring = 64;

}  // namespace geomend::editing
