// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "grid/boundary_model.h"
#include "grid/fault_boxes.h"

namespace geomend::grid {

FaultFaces::FaultFaces(const CornerPointGrid& grid) : grid_(grid) {
    for (std::uint32_t f = 0; f < grid.faults.size(); ++f) {
        for (const auto& box : grid.faults[f].boxes) {
            each_cell(grid, box,
                      [&](std::size_t cell) { faces_.emplace_back(6 * std::uint64_t{cell} + static_cast<std::uint64_t>(box.face), f); });
        }
    }
    std::ranges::sort(faces_);
}

const std::string* FaultFaces::find(std::size_t cell, CellFace face) const {
    const std::uint64_t key = 6 * std::uint64_t{cell} + static_cast<std::uint64_t>(face);
    const auto at = std::ranges::lower_bound(faces_, key, {}, [](const auto& f) { return f.first; });
    return at != faces_.end() && at->first == key ? &grid_.faults[at->second].name : nullptr;
}

}  // namespace geomend::grid
