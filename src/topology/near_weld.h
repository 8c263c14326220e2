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
/// \param tolerance > 0. Cost: linear, some 30 times slower where many positions lie within 64 tolerances of each other; 16 bytes
/// per position, three times as much there.
std::vector<std::uint32_t> clusters_within(std::span<const Vec3> positions, double tolerance);

}  // namespace geomend::topology
