// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "model/corner_point.h"

namespace geomend::grid {

/// Does to computed values of cells what section EDIT does to an array, in its order; `has` says which cells have a value
/// at all. \pre one value per cell. Cost: linear in the cells of the boxes.
template <class Has>
void apply_edits(const CornerPointGrid& grid, std::string_view array, const Has& has, std::span<double> values) {
    using Kind = CornerPointGrid::EditOperation::Kind;
    for (const auto& op : grid.edit_operations) {
        if (op.array != array) continue;
        for (std::uint32_t k = op.first[2]; k <= std::min(op.last[2], grid.dims[2] - 1); ++k) {
            for (std::uint32_t j = op.first[1]; j <= std::min(op.last[1], grid.dims[1] - 1); ++j) {
                for (std::uint32_t i = op.first[0]; i <= std::min(op.last[0], grid.dims[0] - 1); ++i) {
                    const std::size_t cell = grid.cell(i, j, k);
                    if (!has(cell)) continue;
                    double& v = values[cell];
                    v = op.kind == Kind::add        ? v + op.value
                        : op.kind == Kind::multiply ? v * op.value
                        : op.kind == Kind::at_least ? std::max(v, op.value)
                                                    : std::min(v, op.value);
                }
            }
        }
    }
}

}  // namespace geomend::grid
