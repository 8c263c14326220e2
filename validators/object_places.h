// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/finding.h"
#include "model/corner_point.h"

namespace geomend::validators {

/// The middles of the cells that a finding lists (kind "cell-ijk"), as its points, heights as elevations; nothing where the grid has no
/// geometry, or is cylindrical. Cost: linear in what is listed.
void place_cells(const CornerPointGrid& grid, Finding& finding);

}  // namespace geomend::validators
