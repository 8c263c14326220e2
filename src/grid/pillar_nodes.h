// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "model/corner_point.h"

namespace geomend::grid {

/// Per cell 1 where it is active and has thickness on at least one pillar. A cell that is collapsed on all four is no
/// cell to anyone: simulators drop it, and it has no face to share.
std::vector<std::uint8_t> present_cells(const CornerPointGrid& grid);

/// The points of a grid, one for each depth at which a present cell has a corner on a pillar. Numbered pillar by
/// pillar, downwards and without holes; corners at bit-equal depths share a point.
class PillarNodes {
public:
    /// \param present one value per cell, as present_cells() gives it
    PillarNodes(const CornerPointGrid& grid, std::span<const std::uint8_t> present);

    /// \pre a present cell has a corner there
    std::uint32_t id(std::size_t pillar, double depth) const;
    /// The same, quicker where the point is `near` (a number, of whatever pillar) or one of the next few below it.
    std::uint32_t id(std::size_t pillar, double depth, std::uint32_t near) const {
        const std::uint64_t last = std::min<std::uint64_t>(first_[pillar + 1], std::uint64_t{near} + 4);
        for (std::uint64_t at = near; at < last && at >= first_[pillar]; ++at) {
            if (depths_[at] == depth) return static_cast<std::uint32_t>(at);
        }
        return id(pillar, depth);
    }
    std::size_t size() const { return depths_.size(); }
    std::span<const double> on(std::size_t pillar) const { return {depths_.data() + first_[pillar], depths_.data() + first_[pillar + 1]}; }

    /// Positions, elevation-up.
    std::vector<Vec3> points(const CornerPointGrid& grid) const;
    /// The same into an empty array, which may have room for more.
    void add_points(const CornerPointGrid& grid, std::vector<Vec3>& to) const;

private:
    std::vector<std::uint64_t> first_;  // per pillar
    std::vector<double> depths_;
};

/// Number of the pillar under corner c of cell (i,j,k), counted through all sets of coordinate lines.
inline std::size_t pillar_of(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c) {
    const std::size_t set = grid.reservoirs.empty() ? 0 : pillar_set(grid, k);
    return set * pillar_count(grid.dims) + i + (c & 1u) + (std::size_t{grid.dims[0]} + 1) * (std::size_t{j} + ((c >> 1) & 1u));
}

}  // namespace geomend::grid
