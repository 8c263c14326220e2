// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "model/objects.h"
#include "model/volume_mesh.h"

namespace geomend::exchange {

/// The name of the attribute that says of each point which one it was doubled from.
inline constexpr std::string_view doubled_from = "doubled_from";

/// A mesh of cells for formats that take no VolumeMesh: its cells in regions; each surface once, with the vertices of its first side; a
/// surface for each set of faces that is of none; a line for each set of edges; sets of nodes; attributes. Vertices that were doubled
/// stay so, and the attribute "doubled_from" says what each was made from. Linear.
CellMesh cell_mesh_of(const VolumeMesh& mesh);

}  // namespace geomend::exchange
