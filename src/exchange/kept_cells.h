// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "model/volume_mesh.h"

namespace geomend::exchange {

/// How many of the nodes of a second-order cell are kept.
enum class KeptNodes : std::uint8_t { corners, on_edges, all };

/// The type of a cell of which only some nodes are kept; they are the first ones of the cell. Itself where it has no others.
CellType type_with(CellType type, KeptNodes nodes);

/// Some cells of a mesh, with fewer nodes where asked for; vertices that no kept cell uses are left out. Sets, pairs, places and
/// attributes go along; edges whose middle node is left out run from end to end; what stood on cells or vertices that are left
/// out is gone, and sets of which nothing remains are. Regions, surfaces, lines and corners keep their numbers. Linear.
/// \param kept per cell, 1 where it is kept
VolumeMeshData kept_cells(const VolumeMeshData& mesh, std::span<const std::uint8_t> kept, KeptNodes nodes);

}  // namespace geomend::exchange
