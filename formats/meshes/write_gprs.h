// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// Pipe network of GPRS: in the named file the number of pipes and the two cells of each, from 0; beside it volumes (NAME_vol.in) and
/// centres (NAME.xyz) of cells and areas of pipes (NAME_area.in). Failure (usage) where the output is a stream.
/// \pre the mesh was prepared for "gprs"
Result<std::vector<Loss>> write_gprs(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
