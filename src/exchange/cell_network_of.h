// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/cell_network.h"
#include "model/volume_mesh.h"

namespace geomend::exchange {

/// Volumes and centres of all cells, and the faces that two of them share. A face with more than three corners is taken as the
/// triangles between its edges and the mean of its corners, which for quadrangles gives the volume of the bilinear face. Cost: n log n.
CellNetwork cell_network_of(const VolumeMeshData& mesh);

}  // namespace geomend::exchange
