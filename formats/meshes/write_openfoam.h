// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// OpenFOAM polyMesh, as text: beside the named file NAME.foam, which is empty and which ParaView opens, constant/polyMesh with points,
/// faces, owner, neighbour and boundary, cellZones (regions), faceZones (sets of inner faces) and pointZones (node sets). Faces
/// inside come first, by owner and neighbour; those of the border follow by patch, that of the first set which has them; what is in no
/// set is the patch "border". Zones are written also where there are none, in the place of those of an older mesh. Failure (usage) where
/// the output is a stream. \pre the mesh was prepared for "openfoam"
Result<std::vector<Loss>> write_openfoam(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
