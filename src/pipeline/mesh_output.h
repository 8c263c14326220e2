// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "formats/mesh_format.h"
#include "model/volume_mesh.h"

namespace geomend {

/// The mesh of cells in a Dataset as the mesh that writers take, with the model that it states. Other objects, and further meshes,
/// are added to the losses. Builds the dataset's models where that was not done. Failure (cannot_hold) where there is no mesh with a
/// volume.
Result<VolumeMesh> volume_mesh_in(Dataset& dataset, std::vector<Loss>& losses);

/// Prepares a mesh for the needs of a format and prints it.
/// \return what was lost
Result<std::vector<Loss>> write_volume_mesh(const VolumeMesh& mesh, const MeshFormat& format, OutputSet& out, const WriteOptions& options);

}  // namespace geomend
