// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "model/objects.h"

namespace geomend {

/// Signed volume of the polyhedral cell by the divergence theorem over its faces, each split into the fan of its
/// corner with the lowest index. Faces are turned to agree with the first one across shared edges. Faces that do
/// not close (an edge with one face or more than two) are taken as they are wound.
/// \pre mesh.types[cell] == CellType::polyhedron and its faces are given. Cost: n log n in the corners of the faces.
double polyhedron_volume(const CellMesh& mesh, std::size_t cell);

}  // namespace geomend
