// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "model/objects.h"

namespace geomend::validators {

/// For each corner of a hexahedron, wedge or pyramid (but its apex) that corner and the ends of its three edges, in the order
/// in which their determinant has the sign of the cell's volume. Empty for other types.
std::span<const std::array<unsigned, 4>> corner_frames(CellType type);

}  // namespace geomend::validators
