// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/objects.h"

namespace geomend {

/// Per point of a mesh the first one at its position, where faces have a point there; itself elsewhere. Expected linear.
/// \param faces cells
std::vector<std::uint32_t> first_at_places(const CellMesh& mesh, std::span<const std::uint32_t> faces);

/// Where a mesh is split along a surface, its nodes are doubled there, and a file may state the surface from both sides: a triangle or
/// quadrangle on the nodes of one side, and one on those of the other, each the face of one cell, at the same positions; in one entity, or
/// in two, as contact pairs are.
/// \return per cell the face of which it is the other side, or no_index: those are on one side as far as it hangs together, and where
/// there are two entities in that whose name comes first. Empty: there are none.
/// Cost: n log n in the faces of surfaces, linear in points and cells.
std::vector<std::uint32_t> other_sides(const CellMesh& mesh);

}  // namespace geomend
