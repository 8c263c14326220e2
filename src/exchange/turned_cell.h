// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "model/objects.h"

namespace geomend::exchange {

/// Pairs of a cell's own node numbers that change places where the cell is turned inside out (its volume changes sign): corners,
/// and of second-order types the further nodes with them, so that each stays on its edge or face. Empty for polyhedra, whose faces
/// are turned instead, and for cells of other dimensions.
std::span<const std::array<std::uint8_t, 2>> turning_swaps(CellType type);

}  // namespace geomend::exchange
