// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "model/objects.h"

namespace geomend {

/// The cells of a structured grid with more than one node along each direction.
class LatticeCells {
public:
    /// \pre the grid outlives this; it has as many points as its dims say, all dims are at least 2
    explicit LatticeCells(const StructuredGrid& grid);

    std::size_t count() const { return ni_ * nj_ * nk_; }
    /// i, j, k of a cell from 0; i runs fastest.
    std::array<std::size_t, 3> ijk(std::size_t cell) const { return {cell % ni_, cell / ni_ % nj_, cell / ni_ / nj_}; }
    bool is_dead(std::size_t cell) const { return !grid_.dead_cells.empty() && grid_.dead_cells[cell] != 0; }
    /// Its corners in VTK's order for hexahedra; split nodes (Gocad SPLIT) where they stand for this cell.
    std::array<Vec3, 8> corners(std::size_t cell) const;

private:
    const StructuredGrid& grid_;
    std::size_t ni_, nj_, nk_;
    std::map<std::size_t, std::vector<std::pair<std::size_t, Vec3>>> split_;  // per cell: corner and position
};

}  // namespace geomend
