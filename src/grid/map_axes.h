// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/result.h"
#include "model/corner_point.h"

namespace geomend::grid {

/// Moves a grid into map coordinates: each point becomes origin + x ux + y uy, with the two unit vectors that MAPAXES
/// gives (they need not be at right angles or right-handed), in the unit of the map: where that differs from the grid's,
/// all three axes are converted. Nothing happens to a grid that is in map coordinates or states no axes.
/// Errors: F012 where the axes are shorter than 1e-5 or parallel, or a unit is not known; F013 for cylindrical grids.
Result<void> apply_map_axes(CornerPointGrid& grid);

/// Length of a unit (METRES, FEET, CM) in metres; 0 where it is not known.
double metres(std::string_view unit);

}  // namespace geomend::grid
