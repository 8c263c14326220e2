// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "base/result.h"
#include "model/dataset.h"

namespace geomend {

/// Option connections=compute: all pairs of cells that a simulator joins without their being neighbours (grid::connections
/// of grid::simulated_cells) become connections of the grid; where it has PERMX, they and TRANX, TRANY, TRANZ get
/// transmissibilities, which are added to those that are stated. Pairs below 1e-6 are left out then and told (F151), as
/// are cells without enough pore volume (F153).
/// \param from_deck what the grid has as TRANX, TRANY, TRANZ is stated in section EDIT, and takes the place of what is computed
Result<void> compute_connections(CornerPointGrid& grid, bool from_deck, std::vector<Finding>& findings);

}  // namespace geomend
