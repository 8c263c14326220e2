// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "grid/cell_geometry.h"

namespace geomend::grid {

/// How well a cell is shaped. Angles are in degrees, 0 to 180, between edges that meet at a corner of a face; corners
/// where one of the two edges is collapsed have none. Where a cell has no such corner the least angle is 180 and the
/// greatest 0.
struct CellQuality {
    double least_top_base = 180, greatest_top_base = 0;    ///< of the top and the base
    double least_projected = 180, greatest_projected = 0;  ///< of both as seen from above
    double least_side = 180, greatest_side = 0;            ///< of the four sides
    double aspect = 1;          ///< longest over shortest of the mean edges along I, J, K; infinite where one is 0
    double least_jacobian = 0;  ///< least over corners of the determinant over the product of its edges, -1 to 1; corners
                                ///< on a collapsed edge are left out. Its sign is that of (x, y, depth)
};

/// \param zero_length edges up to this length are collapsed
CellQuality cell_quality(const Corners& corners, double zero_length = 0);

/// The same of each cell as attributes: minangle_topbase, maxangle_topbase, minangle_topbase_proj, maxangle_topbase_proj,
/// minangle_sides, maxangle_sides (the names that are usual for them), aspect and min_jacobian, the last one positive
/// where a cell is turned like most of the grid. Inactive cells have values, too. Cost: linear, in parallel.
std::vector<Attribute> quality_attributes(const CornerPointGrid& grid);

}  // namespace geomend::grid
