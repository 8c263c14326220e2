// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "model/objects.h"

namespace geomend {

/// For each corner of a tetrahedron, hexahedron, wedge or pyramid (but its apex, which has four edges) that corner and the ends of its
/// three edges, in the order in which their determinant is positive in a cell whose nodes are in VTK's order. Empty for other types.
std::span<const std::array<unsigned, 4>> corner_frames(CellType type);

}  // namespace geomend
