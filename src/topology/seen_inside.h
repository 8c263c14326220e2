// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "topology/used_points.h"

namespace geomend::topology {

/// Whether triangles enclose a body that is seen from each of some of its vertices as a whole, from inside: all triangles that do not
/// have the vertex show it the same side, as the base of a cone does to its apex. So a vertex that closes a body is told from one that
/// was pulled out of it, to which triangles around its neighbours show their outer sides. How triangles are wound plays no part.
/// \param triangles numbers of triangles; those with equal corners count for nothing
/// Cost: n log n in the triangles, for each vertex linear.
bool is_body_seen_from(const UsedPoints& used, std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> vertices);

}  // namespace geomend::topology
