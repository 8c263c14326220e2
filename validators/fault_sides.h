// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "model/corner_point.h"

// The sides of cells that fault records are for.

namespace geomend::validators {

using Fault = CornerPointGrid::Fault;

constexpr std::size_t axis_of(CellFace face) { return static_cast<std::size_t>(face) / 2; }
constexpr bool is_plus(CellFace face) { return (static_cast<unsigned>(face) & 1u) != 0; }

inline bool inside(const CornerPointGrid& grid, const Fault::Box& box) {
    for (std::size_t a = 0; a < 3; ++a) {
        if (box.first[a] > box.last[a] || box.last[a] >= grid.dims[a]) return false;
    }
    return true;
}

inline bool flat(const Fault::Box& box) { return box.first[axis_of(box.face)] == box.last[axis_of(box.face)]; }

/// The neighbour of a cell along I (axis 0) or J (axis 1), or the number of cells.
inline std::size_t neighbour(const CornerPointGrid& grid, const std::array<std::uint32_t, 3>& at, std::size_t axis) {
    if (at[axis] + 1 >= grid.dims[axis]) return grid.cell_count();
    return grid.cell(at[0] + (axis == 0 ? 1 : 0), at[1] + (axis == 1 ? 1 : 0), at[2]);
}

/// Calls body(cell, axis) for each +I (axis 0) and +J (axis 1) side that a record is for. Sides on the border of the grid
/// and tops and bottoms have no throw and are left out.
template <class Body>
void each_stated_side(const CornerPointGrid& grid, const Fault& fault, const Body& body) {
    for (const Fault::Box& box : fault.boxes) {
        const std::size_t axis = axis_of(box.face);
        if (axis == 2 || !inside(grid, box) || !flat(box)) continue;
        auto first = box.first, last = box.last;
        if (!is_plus(box.face)) {  // the same side is the + side of the cell before
            if (first[axis] == 0) continue;
            --first[axis];
            --last[axis];
        }
        for (std::uint32_t k = first[2]; k <= last[2]; ++k) {
            for (std::uint32_t j = first[1]; j <= last[1]; ++j) {
                for (std::uint32_t i = first[0]; i <= last[0]; ++i) {
                    if (neighbour(grid, {i, j, k}, axis) < grid.cell_count()) body(grid.cell(i, j, k), axis);
                }
            }
        }
    }
}

}  // namespace geomend::validators
