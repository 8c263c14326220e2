// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "model/objects.h"

namespace geomend::grid {

/// Adds the cell with these eight corners (in the order of corner_index; equal numbers where they coincide): a
/// hexahedron, and where corners coincide a wedge, pyramid or tetrahedron if its faces are just those, else a polyhedron
/// of the faces that have area.
/// \param right_handed of the corners in (x, y, depth), where the mesh is elevation-up
/// \pre mesh.points holds the corners
void add_cell(const std::array<std::uint32_t, 8>& corners, bool right_handed, CellMesh& mesh);

}  // namespace geomend::grid
