// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "exchange/solid_cells.h"

namespace geomend::exchange {

/// Adds a set of faces for each pair of regions, and for each region and the outside, that meet where no set has a face on either side:
/// boundary conditions need them, whether or not a file states its surfaces. They are called after both ("lower_upper",
/// "lower_outside") and hold the faces of the first one's cells. Faces at the same positions count as one face, so that a mesh that
/// is split along a surface has no outside there. Cost: n log n in the faces of cells.
void add_region_faces(SolidCells& cells);

}  // namespace geomend::exchange
