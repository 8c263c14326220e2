// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>

#include "base/result.h"
#include "model/corner_point.h"

namespace geomend::grid {

/// A frame near a grid, whose axes run as those of the grid's own map axes: MAPAXES of it is exact in single precision
/// where that can be, so that little is lost in files that store float32.
struct LocalFrame {
    std::array<double, 2> origin{};  ///< in map coordinates, a round number
    std::array<double, 6> map_axes{};
};

/// The frame for a grid: its origin is the point of the map nearest to the middle of the grid whose coordinates are
/// multiples of the largest power of ten (at least 1) within the grid's extent. A grid that is in map coordinates, or
/// states no map axes, gets axes along those of the map.
/// Errors: F012, F013 as apply_map_axes(). \pre the grid has pillars
Result<LocalFrame> local_frame(const CornerPointGrid& grid);

/// Moves a grid into a frame: map_axes becomes that of the frame, and apply_map_axes() gives back the map coordinates.
/// \returns how far rounding MAPAXES to single precision moves a corner of the grid's box on the map, in map units
/// Errors: as local_frame()
Result<double> move_into(const LocalFrame& frame, CornerPointGrid& grid);

}  // namespace geomend::grid
