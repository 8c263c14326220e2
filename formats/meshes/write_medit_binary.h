// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "base/output.h"
#include "formats/format.h"
#include "model/volume_mesh.h"

namespace geomend::meshes {

/// The binary form of write_medit(), version 3, lowest byte first: the same cells, faces and edges with the same numbers, without names.
Result<std::vector<Loss>> write_medit_binary(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
