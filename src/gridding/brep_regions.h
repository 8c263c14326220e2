// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/brep.h"
#include "model/corner_point.h"

namespace geomend::gridding {

/// The region of a model that each cell's middle lies in, as attribute REGION: 1 for the first region, with their names; 0 for none, and
/// for cells that are not active. Exact but for the rounding of middles. Cost: logarithmic a cell, in parallel.
Attribute brep_regions(const CornerPointGrid& grid, const BrepData& brep);

}  // namespace geomend::gridding
