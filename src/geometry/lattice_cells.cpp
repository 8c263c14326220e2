// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/lattice_cells.h"

namespace geomend {

LatticeCells::LatticeCells(const StructuredGrid& grid) : grid_(grid), ni_(grid.dims[0] - 1), nj_(grid.dims[1] - 1), nk_(grid.dims[2] - 1) {
    // VTK corner of a cell by its offsets in i, j, k.
    constexpr std::array<std::size_t, 8> corner_of = {0, 1, 3, 2, 4, 5, 7, 6};
    for (const StructuredGrid::Split& split : grid.splits) {
        for (std::size_t b = 0; b < 8; ++b) {
            if ((split.cells >> b & 1) == 0) continue;
            // Bit b stands for the cell that is this many steps before the node.
            const std::size_t di = b & 1, dj = b >> 1 & 1, dk = b >> 2;
            if (split.node[0] < di || split.node[1] < dj || split.node[2] < dk) continue;
            const std::size_t i = split.node[0] - di, j = split.node[1] - dj, k = split.node[2] - dk;
            if (i < ni_ && j < nj_ && k < nk_) split_[(k * nj_ + j) * ni_ + i].emplace_back(corner_of[b], split.position);
        }
    }
}

std::array<Vec3, 8> LatticeCells::corners(std::size_t cell) const {
    const auto [i, j, k] = ijk(cell);
    const std::size_t row = grid_.dims[0], layer = row * grid_.dims[1], at = k * layer + j * row + i;
    const auto& p = grid_.points;
    std::array<Vec3, 8> corners = {p[at],         p[at + 1],         p[at + row + 1],         p[at + row],
                                   p[at + layer], p[at + layer + 1], p[at + layer + row + 1], p[at + layer + row]};
    if (const auto moved = split_.find(cell); moved != split_.end()) {
        for (const auto& [corner, position] : moved->second) corners[corner] = position;
    }
    return corners;
}

}  // namespace geomend
