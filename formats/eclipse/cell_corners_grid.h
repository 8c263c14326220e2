// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/corner_point.h"

namespace geomend::eclipse {

/// A grid of which cells are known by their own eight corners.
struct CornerCells {
    std::vector<std::uint64_t> cells;  ///< numbers in the grid, each once
    std::vector<float> corners;        ///< 24 a cell: x y z of corners 0 to 7 of corner_index()
};

/// Sets pillars and depths of a grid from the corners of its cells. A pillar runs through the highest and the lowest
/// corner on it. Pillars and cells that nothing is known of are put between or beside those around them.
/// \pre grid.dims are set, and the numbers of cells are within them
/// \return a cell with a corner that is not on the line of its pillar, so that these are no corner-point cells, as
/// "(i,j,k) ..." from 1; nothing where all is well
std::optional<std::string> set_geometry(const CornerCells& known, CornerPointGrid& grid);

}  // namespace geomend::eclipse
