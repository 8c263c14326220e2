// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// TOUGH2 MESH: ELEME with names of five characters (three of 0-9 and A-Z, the first a letter, and two figures), the region as
/// material, volumes and centres; CONNE with distances to the face along the line between the centres, areas and BETAX, the cosine
/// between that line and gravity: more than 0 where the second element lies deeper. ISOT is 1 for connections that are more level
/// than steep, 3 for others. Failure (cannot_hold) above 3,369,600 cells. \pre the mesh was prepared for "tough2"
Result<std::vector<Loss>> write_tough2(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
