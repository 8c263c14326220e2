// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// A FEFLOW problem in three dimensions (.fem) with nothing but its mesh: elements of any type, nodes, regions as sets of elements, and
/// chains of edges (wells) as discrete features. What flows, and through what, is for FEFLOW itself to say.
/// \pre the mesh was prepared for "feflow"
Result<std::vector<Loss>> write_feflow(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
