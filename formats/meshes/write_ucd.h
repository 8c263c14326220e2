// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// AVS UCD text, as LaGriT, AVS and ParaView read it: vertices; cells with the number of their region (from 1) as material; attributes that
/// are numbers over vertices and over cells, with their names and units. What the numbers of regions are called stands in comments.
/// \pre the mesh was prepared for "avs-ucd"
Result<std::vector<Loss>> write_ucd(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
