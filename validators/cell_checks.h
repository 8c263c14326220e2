// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "validators/cell_scope.h"

// The checks of cell meshes; the table that joins them is in registry.cpp. Each adds one finding for the mesh, or none.

namespace geomend::validators {

void check_cell_volumes(const CellScope&, std::vector<Finding>&);    // M20 M35
void check_cell_jacobians(const CellScope&, std::vector<Finding>&);  // M21
void check_cell_nodes(const CellScope&, std::vector<Finding>&);      // M22
void check_cell_faces(const CellScope&, std::vector<Finding>&);      // M23
void check_cell_contacts(const CellScope&, std::vector<Finding>&);   // M24 M36
void check_polyhedra(const CellScope&, std::vector<Finding>&);       // M25
void check_cell_repeats(const CellScope&, std::vector<Finding>&);    // M26
void check_cell_points(const CellScope&, std::vector<Finding>&);     // M27 M28
void check_cell_overlaps(const CellScope&, std::vector<Finding>&);   // M29
void check_cell_gaps(const CellScope&, std::vector<Finding>&);       // M38
void check_cell_surfaces(const CellScope&, std::vector<Finding>&);   // M39
void check_face_planes(const CellScope&, std::vector<Finding>&);     // Q10

}  // namespace geomend::validators
