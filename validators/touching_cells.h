// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>

#include "validators/grid_scope.h"

namespace geomend::validators {

/// Calls body(a, b, lateral) for each pair of present cells that touch: as simulators connect them, as the file states,
/// and one above the other within the tolerance; lateral: of different columns. Not for
/// several threads at once before scope.connections() has been called.
template <class Body>
void each_touch(const GridScope& scope, const Body& body) {
    const auto& grid = scope.grid();
    const grid::Connections& all = scope.connections();
    const std::size_t cells = grid.cell_count();
    for (std::size_t cell = 0; cell < cells; ++cell) {
        if (all.present[cell] == 0) continue;
        const unsigned to = all.neighbours[cell];
        if ((to & grid::Connections::east) != 0) body(cell, cell + 1, true);
        if ((to & grid::Connections::south) != 0) body(cell, cell + grid.dims[0], true);
        const std::size_t below = grid::next_below(grid, all.present, cell);
        if (below == cells) continue;
        if ((to & grid::Connections::below) != 0) {
            body(cell, below, false);
            continue;
        }
        const auto [i, j, k] = grid.ijk(cell);
        const std::uint32_t lower = grid.ijk(below)[2];
        bool near = scope.judged(cell) && scope.judged(below);
        for (unsigned c = 0; c < 4 && near; ++c)
            near = std::abs(scope.depth(i, j, lower, c) - scope.depth(i, j, k, c + 4)) <= scope.depth_tolerance();
        if (near) body(cell, below, false);
    }
    for (const grid::NonNeighbour& n : all.others) body(n.first, n.second, n.face != CellFace::k_plus);
    for (const auto& c : grid.connections) {
        const std::size_t a = c.first % cells, b = c.second % cells;  // of two porosities both parts are in one cell
        if (all.present[a] != 0 && all.present[b] != 0 && a != b)
            body(a, b, a % (std::size_t{grid.dims[0]} * grid.dims[1]) != b % (std::size_t{grid.dims[0]} * grid.dims[1]));
    }
}

/// Whether the numbers of cells fit into those of DisjointSets.
inline bool fits_in_32_bits(const CornerPointGrid& grid) { return grid.cell_count() < 0xffffffffu; }

}  // namespace geomend::validators
