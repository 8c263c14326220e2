// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// MFEM mesh v1.0: tetrahedra and hexahedra with the number of their region (from 1), faces of sets as boundary with that of their
/// set, vertices. A mesh without sets gets its boundary from MFEM itself. \pre the mesh was prepared for "mfem"
Result<std::vector<Loss>> write_mfem(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
