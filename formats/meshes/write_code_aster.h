// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// Code_Aster text (.mail): COOR_3D; TETRA4, PYRAM5, PENTA6, HEXA8 by type, TRIA3 and QUAD4 of face sets, SEG2 of edge sets; GROUP_MA for
/// each region and each set of faces and edges, GROUP_NO for node sets. \pre the mesh was prepared for "code-aster": split along faults
Result<std::vector<Loss>> write_code_aster(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
