// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::topology {

/// For each position the first one of its cluster. Two positions at most `tolerance` apart are in one cluster, and so are
/// those that a chain of such pairs links.
/// \param positions finite
/// \param tolerance > 0. Cost: linear where few positions are that near; 16 bytes per position.
std::vector<std::uint32_t> clusters_within(std::span<const Vec3> positions, double tolerance);

}  // namespace geomend::topology
