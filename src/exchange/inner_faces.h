// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "model/volume_mesh.h"

namespace geomend::exchange {

/// Two faces of cells that have the same vertices; the one of the lower cell first.
using InnerFace = std::array<CellFaceRef, 2>;

/// All faces that two cells share, ascending by their vertices. Cost: linear.
std::vector<InnerFace> inner_faces(const VolumeMeshData& mesh);

/// The vertices of a face as its cell has them, wound outwards. Logarithmic in the number of blocks.
std::vector<std::uint32_t> nodes_of(const VolumeMeshData& mesh, const CellFaceRef& face);

}  // namespace geomend::exchange
