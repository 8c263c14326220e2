// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "hexes/closing.h"
#include "model/loss.h"
#include "model/volume_mesh.h"

namespace geomend::hexes {

/// The mesh that new cells make of an old one: its other cells, sets, places and attributes go along. Cells take the values of the
/// largest tetrahedron that they hold a part of; new vertices those in the middle of the quadrangle they stand behind.
/// \param tets of the old mesh, from which the cells were made
/// Failure (internal) where cells do not fit together. Cost: n log n.
Result<VolumeMesh> assemble(const VolumeMesh& old, const TetMesh& tets, MixedMesh mixed);

}  // namespace geomend::hexes
