// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gridding/build_grid.h"

namespace geomend {

/// A grid and the model that it was made of.
struct GridDrawing {
    CornerPointGrid grid;
    gridding::Structure structure;
    std::vector<gridding::ZoneReport> zones;
};

/// A row of columns: all of one J, from I to I, or all of one I.
struct GridRow {
    bool along_i = true;
    std::uint32_t number = 0;  ///< from 0
};

/// The row that crosses the most faces of faults; of equal ones that with the most active columns, then the one nearest to the middle.
GridRow telling_row(const CornerPointGrid& grid);

/// The grid from above: active columns by the depth of their uppermost cell, edges of columns at mid level, faces of faults red; of the
/// model the traces and polygons of faults, black. As PNG.
std::string grid_map(const GridDrawing& drawing, const GridRow& row);

/// A section along the pillars of a row, those of lower J or I: active cells by zone and their edges; of the model horizons and surfaces of
/// faults where they meet the plane through the row's ends, black and red. As PNG; the scale of depth is not that of length.
std::string grid_section(const GridDrawing& drawing, const GridRow& row);

}  // namespace geomend
