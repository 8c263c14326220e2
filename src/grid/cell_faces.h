// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "grid/cell_mesh.h"
#include "model/corner_point.h"

namespace geomend::grid {

/// Fills `cells` with the present cells of a grid as polyhedra that fit face to face: source, collapsed, unmatched_columns
/// and of the mesh points, types, cell_faces, face_offsets and face_nodes. The faces of a cell are those that
/// conforming_faces() gives, in its order; they are made twice, once to count them, since that costs less than to keep them.
/// \pre cells is empty; misfit(grid) is empty; fewer than 2^32 - 1 cells. Cost: n log n in layers per column
void add_conforming_faces(const CornerPointGrid& grid, Cells& cells);

}  // namespace geomend::grid
