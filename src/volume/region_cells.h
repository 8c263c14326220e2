// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/result.h"
#include "volume/tetrahedra.h"

namespace geomend::volumes {

/// The tetrahedra that fill a region, over the vertices of its facets and new ones.
struct RegionCells {
    std::vector<Vec3> new_vertices;
    std::vector<std::array<std::uint32_t, 4>> cells;  ///< each with a positive volume, as orientation() has it
    double volume = 0;
    double least_dihedral = 180;  ///< degrees
};

/// The tetrahedra on the region's sides of its facets, with no others. All is proven: each facet is a face of one cell on each side
/// that the region has, no cell is flat (exact predicates), no face has more than two cells, and volumes agree within 1e-9.
/// Failure (limit, F026) with what is not so and where. Cost: n log n in the number of cells.
Result<RegionCells> cells_of_region(const RegionFacets& facets, Tetrahedra all);

}  // namespace geomend::volumes
