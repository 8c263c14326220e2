// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/objects.h"

namespace geomend {

/// Where a mesh is split along a surface, its nodes are doubled there, and a file may state the surface from both sides: a triangle or
/// quadrangle on the nodes of one side, and one on those of the other, each the face of one cell, at the same positions, in one entity.
/// \return per cell the face of which it is the other side, or no_index: those are on one side as far as it hangs together. Empty:
/// there are none.
/// Cost: n log n in the points of surfaces, linear in the cells.
std::vector<std::uint32_t> other_sides(const CellMesh& mesh);

}  // namespace geomend
