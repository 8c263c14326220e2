// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// Exodus II in classic netCDF with 64-bit offsets: an element block for each region and type, side sets of faces, node sets, and values
/// at nodes and of elements in one step of time; vectors as one variable for each component. Blocks and sets have numbers from 1 and
/// names. After the Exodus II manual (L. Schoof, V. Yarberry, SAND92-2137, and its later revisions).
/// \pre the mesh was prepared for "exodus". Failure as of NetcdfFile::write().
Result<std::vector<Loss>> write_exodus(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
