// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::validators {

/// Segments put together into polylines where their ends are equal to the bit and no third one ends there. Segments without
/// length are left out. In the order of their first segments. Cost: n log n.
std::vector<std::vector<Vec3>> join_segments(std::span<const std::array<Vec3, 2>> segments);

}  // namespace geomend::validators
