// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// Medit text: vertices, tetrahedra, prisms and hexahedra with the number of their region (from 1); triangles and quadrangles of face
/// sets and edges of edge sets with that of their set. What the numbers are called stands in comments.
/// \pre the mesh was prepared for "medit"
Result<std::vector<Loss>> write_medit(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
