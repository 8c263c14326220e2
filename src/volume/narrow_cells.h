// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "volume/region_cells.h"
#include "volume/region_facets.h"

namespace geomend::volumes {

/// Cells with an angle between two faces of less than 5 degrees.
struct NarrowCells {
    std::uint64_t all = 0;
    std::uint64_t forced = 0;  ///< of them within one size of where facets meet below 10 degrees or lie nearer than half the size
};

/// Counts them. \param size of edges. Cost: linear in cells, and some 0.1 ms for each that is narrow.
NarrowCells narrow_cells(const RegionFacets& facets, const RegionCells& region, double size);

}  // namespace geomend::volumes
