// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "grid/boundary_model.h"

namespace geomend::grid {

FaultFaces::FaultFaces(const CornerPointGrid& grid) : grid_(grid) {
    for (std::uint32_t f = 0; f < grid.faults.size(); ++f) {
        for (const auto& box : grid.faults[f].boxes) {
            for (std::uint32_t k = box.first[2]; k <= box.last[2] && k < grid.dims[2]; ++k) {
                for (std::uint32_t j = box.first[1]; j <= box.last[1] && j < grid.dims[1]; ++j) {
                    for (std::uint32_t i = box.first[0]; i <= box.last[0] && i < grid.dims[0]; ++i)
                        faces_.emplace_back(6 * std::uint64_t{grid.cell(i, j, k)} + static_cast<std::uint64_t>(box.face), f);
                }
            }
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
