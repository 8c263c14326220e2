// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// TetGen: .node with point attributes that are numbers, .ele with 4 or 10 nodes and the number of the region (from 1), .neigh with the
/// cells beyond the faces opposite to the corners and, where the mesh has face sets, .face with the number of the set; all with the name of
/// the output, each but the one that was named a companion. What the numbers are called stands in comments. Failure (usage) where the
/// output is a stream. \pre the mesh was prepared for "tetgen"
Result<std::vector<Loss>> write_tetgen(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
