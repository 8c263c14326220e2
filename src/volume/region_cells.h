// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "volume/region_facets.h"
#include "volume/tetrahedra.h"

namespace geomend::volumes {

/// How many cells have which shape.
struct ShapeCounts {
    std::array<std::uint64_t, 15> least_dihedral{};  ///< by the least angle between faces, in steps of 5 degrees; 70.5 is most
    std::array<std::uint64_t, 10> shape{};           ///< by 3 times inner by outer radius, in steps of a tenth
};

/// The tetrahedra that fill a region, over the vertices of its facets and new ones.
struct RegionCells {
    std::vector<Vec3> new_vertices;
    std::vector<std::array<std::uint32_t, 4>> cells;  ///< each with a positive volume, as orientation() has it
    double volume = 0;
    double least_dihedral = 180;  ///< degrees
    ShapeCounts shapes;
};

/// The tetrahedra on the region's sides of its facets, with no others. All is proven: each facet is a face of one cell on each side
/// that the region has, each of its edges an edge of a cell, no cell is flat (exact predicates), no face has more than two cells, and
/// volumes agree within 1e-9. Failure (limit, F026) with what is not so and where. Cost: n log n in the number of cells.
Result<RegionCells> cells_of_region(const RegionFacets& facets, Tetrahedra all);

/// Whether the two cells at each face lie on its two sides, by how they are wound: those that are all but flat may be turned over by
/// rounding, and overlap. \pre each cell has a positive volume. Cost: n log n.
bool lie_apart(std::span<const std::array<std::uint32_t, 4>> cells);

/// Volume, least angle and shapes of the cells as they stand. Linear.
void measure(const RegionFacets& facets, RegionCells& region);

}  // namespace geomend::volumes
