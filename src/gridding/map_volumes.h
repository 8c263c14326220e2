// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "gridding/build_grid.h"

namespace geomend::gridding {

/// Per zone what its two maps hold between them, as they are, below the columns with active cells of the zone: by 4x4 places a column;
/// places at which a map has no value, and columns with such, are left out. Empty where not all horizons are maps, or pillars lean.
/// Cost: linear in columns.
std::vector<double> map_volumes(const Structure& structure, const CornerPointGrid& grid, std::span<const ZoneReport> zones);

}  // namespace geomend::gridding
