// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "exchange/solid_cells.h"
#include "model/brep.h"
#include "model/loss.h"

namespace geomend::exchange {

/// Adds to the mesh the surfaces of a model, and a face set for each surface and each side of it on which cells have its polygons as
/// faces: front is the side that normals point into; of a fault that is neither vertical nor flat the side above is the hanging wall.
/// A set has the name of its interface, followed by its side where the interface has cells on both sides. Where the cells on both
/// sides have vertices of their own, the two faces become a split pair. Polygons that are no face of a cell are listed.
/// \pre the model's vertices lie at positions of the cells' mesh. Cost: n log n in polygons, a search for each face of a cell.
void add_surface_faces(const BrepData& model, SolidCells& cells, std::vector<Loss>& losses);

}  // namespace geomend::exchange
