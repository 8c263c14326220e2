// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/monitor.h"
#include "volume/region_cells.h"
#include "volume/region_facets.h"

namespace geomend::volumes {

/// What was done to cells.
struct Improvement {
    std::uint64_t bad_before = 0, bad_after = 0;  ///< cells with an angle between faces below 10 or above 170 degrees
    std::uint64_t flips = 0, moves = 0;
    std::uint64_t vertices = 0;  ///< that were inserted
};

/// Makes the worst cells better, facets and their vertices fixed: edges inside are removed, faces inside are flipped, and new vertices
/// moved, each only where the worst of the cells around becomes better by it, in the order of cells. Cells stay the right way out
/// (exactly), and fill the same region. Results depend on the cells alone. Cost: as the number of bad cells and of those around them.
/// Source: L. Freitag, C. Ollivier-Gooch, Tetrahedral mesh improvement using swapping and smoothing (1997); the ring around an edge is
/// filled as by G. Klincsek (1980); A. Botella (2016), 2.6.4, for moves that make no cell around worse.
/// \param kept more edges that stay, over the same vertices
/// \param inserts whether bad cells that nothing else helps give way to new vertices, where the worst of those that go is less than two
/// thirds as good as those that come (five sixths where it has an angle of less than 5 degrees); new vertices may go, too. Between facets
/// that lie close to each other or meet sharply only what makes no more bad cells. \pre then facets have their sides
/// \param size of edges: with it, and with inserts, cells below 5 degrees that surfaces force (see forced_places.h) are tried once only
Improvement improve(const RegionFacets& facets, RegionCells& region, const Monitor* monitor,
                    std::span<const std::array<std::uint32_t, 2>> kept = {}, bool inserts = false, double size = 0);

/// Removes cells that are flat on two facets, by the one edge inside that they have: where a surface is even all four vertices of a cell
/// may lie in it. Where what takes their place would be turned over by rounding, between points inside, one of those moves by some
/// millionths of an edge; so do those of flat cells inside that are turned over. Others stay as they are, but for so many that have no
/// volume or are turned over: they get a new vertex beside them. Cost: linear, and as the cells around these.
Improvement remove_flat_cells(const RegionFacets& facets, RegionCells& region, std::uint64_t most_vertices = 0);

}  // namespace geomend::volumes
