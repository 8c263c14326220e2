// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "geometry/surface_distance.h"

namespace geomend {

/// How far a way may go from where it starts, and how many pairs of triangles it may look at.
inline constexpr double walk_reach = 10;  ///< times the search length
inline constexpr std::size_t walk_steps = 20000;

/// Whether a way leads from a place where two surfaces are near to one where they meet: over both surfaces at a time, with never
/// more than `near` between the two points, over triangles that come within 10 `near` of where it starts. Surfaces meet where they
/// have a vertex or any other point in common, and where a third surface joins them: both points lie on it.
/// \param a, b triangles by their places in the tree, less than `near` apart; \param start the place, a point of a
/// Given up after 20,000 pairs of triangles: false. Cost: about a microsecond for each pair; downhill first.
bool leads_to_meeting(const SurfaceDistance& soup, std::uint32_t a, std::uint32_t b, const Vec3& start, double near);

}  // namespace geomend
