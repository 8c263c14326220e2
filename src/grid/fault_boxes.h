// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/corner_point.h"

namespace geomend::grid {

/// Calls body(cell) for each cell of a fault record that lies in the grid, in the order of cell numbers.
template <class Body>
void each_cell(const CornerPointGrid& grid, const CornerPointGrid::Fault::Box& box, const Body& body) {
    for (std::uint32_t k = box.first[2]; k <= box.last[2] && k < grid.dims[2]; ++k) {
        for (std::uint32_t j = box.first[1]; j <= box.last[1] && j < grid.dims[1]; ++j) {
            for (std::uint32_t i = box.first[0]; i <= box.last[0] && i < grid.dims[0]; ++i) body(grid.cell(i, j, k));
        }
    }
}

}  // namespace geomend::grid
