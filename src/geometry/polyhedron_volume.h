// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "model/objects.h"

namespace geomend {

/// Signed volume of the polyhedral cell by the divergence theorem over its faces, each split into the fan of its
/// corner with the lowest index. Faces are turned to agree with the first one across shared edges. Faces that do
/// not close (an edge with one face or more than two) are taken as they are wound.
/// \pre mesh.types[cell] == CellType::polyhedron and its faces are given. Cost: n log n in the corners of the faces.
double polyhedron_volume(const CellMesh& mesh, std::size_t cell);

/// Per face of the polyhedral cell whether it must be turned to agree with the first face of its shell, as polyhedron_volume() does;
/// empty where nothing is to be turned, or where the faces do not close. \pre and cost as there.
std::vector<bool> faces_to_turn(const CellMesh& mesh, std::size_t cell);

}  // namespace geomend
