// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/result.h"
#include "model/objects.h"

namespace geomend::grid {

/// A curvilinear grid as corner-point grid: exact where the points of each column of nodes lie on a straight line, to
/// within 1e-6 of its length; nodes split at faults get their own depths. Blanked cells become inactive, k is turned
/// round where it runs upwards. Failure F021 names the first cell that does not fit.
Result<CornerPointGrid> from_structured(const StructuredGrid& grid);

/// Cells with attributes I, J and K (from 1) as corner-point grid. Pillars are the lines through the corners of
/// hexahedra; corners of other cells are sorted onto them, so that wedges and other pinched cells come back, too, and
/// where such a cell has three pillars its other corners make the fourth. Cells
/// that are missing are inactive, without thickness, between their neighbours. Failure F021 names the first cell that
/// does not fit, F007 says which attribute is missing.
Result<CornerPointGrid> from_tagged_cells(const CellMesh& mesh);

/// True where a mesh has the attributes that from_tagged_cells needs.
bool has_places(const CellMesh& mesh);

/// Puts the attributes of a mesh onto a grid, cell by cell: by GlobalIndex, else by I, J, K. Cells that the mesh does not
/// hold get the attribute's no-data value. Attributes that only say the place are left out. Failure F021 names the first
/// cell that is not in the grid, or is there twice.
Result<void> put_attributes(const CellMesh& mesh, CornerPointGrid& grid);

}  // namespace geomend::grid
