// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// PFLOTRAN, explicit unstructured grid (.uge): CELLS with centres and volumes, CONNECTIONS with the centre and the area of each face;
/// beside it the numbers of the cells of each region (NAME_REGION.txt) and the faces of each set on the border (NAME_SET.ex). Failure
/// (usage) where the output is a stream. \pre the mesh was prepared for "pflotran"
Result<std::vector<Loss>> write_pflotran(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
