// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/corner_point.h"

namespace geomend::grid {

/// Corner depths with those of a column beside each other. In the grid, they lie one plane of corners apart, each on a page
/// of its own; so a row of corners is read plane by plane, once, for all its columns. Holds the last four rows asked for:
/// enough for whoever goes from row to row of cells and looks at the next or the last one.
class ColumnDepths {
public:
    /// \param grid must live as long as this
    explicit ColumnDepths(const CornerPointGrid& grid) : grid_(grid) {}

    /// The depths of one column of corners, downwards: top and bottom of layer 0, of layer 1, and so on; 2 nz of them.
    /// \param column 0 .. 2 nx - 1, \param row 0 .. 2 ny - 1; valid until a row is asked for that is four or more away
    const double* column(std::size_t column, std::size_t row) {
        Row& held = rows_[row % rows_.size()];
        if (held.row != row || held.depths.empty()) read(row, held);
        return held.depths.data() + column * stride();
    }

private:
    struct Row {
        std::size_t row = 0;
        std::vector<double> depths;
    };
    // Of columns; an odd number of cache lines, so that columns beside each other do not fall on the same place of a cache.
    std::size_t stride() const { return (2 * std::size_t{grid_.dims[2]} + 7) / 8 * 8 | 8; }
    void read(std::size_t row, Row& to) const;

    const CornerPointGrid& grid_;
    std::array<Row, 4> rows_;
};

}  // namespace geomend::grid
