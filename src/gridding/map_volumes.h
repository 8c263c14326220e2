// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "gridding/build_grid.h"

namespace geomend::gridding {

/// What lies between two maps, as they are, and between the same horizons of a grid, both only where both maps have values.
struct MapVolume {
    double maps = 0, grid = 0;
};

/// Per zone, below the columns with active cells of the zone, by 4x4 places a column. Empty where not all horizons are maps, or pillars
/// lean. Cost: linear in columns.
std::vector<MapVolume> map_volumes(const Structure& structure, const CornerPointGrid& grid, std::span<const ZoneReport> zones);

}  // namespace geomend::gridding
