// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/column_depths.h"

#include <algorithm>

namespace geomend::grid {

void ColumnDepths::read(std::size_t row, Row& to) const {
    constexpr std::size_t planes_at_once = 8;  // one cache line of each column is written whole
    const std::size_t columns = 2 * std::size_t{grid_.dims[0]}, planes = 2 * std::size_t{grid_.dims[2]};
    const std::size_t plane = columns * 2 * grid_.dims[1];
    to.row = row;
    to.depths.resize(columns * stride());
    const double* first = grid_.depths.data() + row * columns;
    for (std::size_t p = 0; p < planes; p += planes_at_once, first += planes_at_once * plane) {
        double* written = to.depths.data() + p;
        const std::size_t count = std::min(planes_at_once, planes - p);
        for (std::size_t c = 0; c < columns; ++c, written += stride()) {
            for (std::size_t q = 0; q < count; ++q) written[q] = first[q * plane + c];
        }
    }
}

}  // namespace geomend::grid
