// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend {

/// A search tree over boxes along the axes: they are put in the order of a Morton curve through their centres, and boxes are put
/// around each eight, each eight of these, and so on. Cost: n log n to make, some 0.2 s per million; 56 bytes per box.
class BoxTree {
public:
    using Corners = std::array<Vec3, 2>;  ///< low, high

    /// \pre all coordinates are finite, low <= high
    explicit BoxTree(std::span<const Corners> boxes);

    /// Calls visit(number) for each box that has more than `depth` in common with the given one along each axis.
    template <class Visit>
    void visit(const Corners& box, double depth, const Visit& visit) const {
        if (!order_.empty()) visit_below(levels_.size() - 1, 0, levels_.back().size(), box, depth, visit);
    }

private:
    static constexpr std::size_t width = 8;
    std::vector<std::uint32_t> order_;
    std::vector<std::vector<Corners>> levels_;  ///< level 0: the boxes themselves, in order

    static bool meet(const Corners& a, const Corners& b, double depth) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::min(a[1][k], b[1][k]) - std::max(a[0][k], b[0][k]) <= depth) return false;
        }
        return true;
    }

    template <class Visit>
    void visit_below(std::size_t level, std::size_t first, std::size_t last, const Corners& box, double depth, const Visit& visit) const {
        for (std::size_t i = first; i < last; ++i) {
            if (!meet(levels_[level][i], box, depth)) continue;
            if (level == 0) visit(order_[i]);
            else visit_below(level - 1, width * i, std::min(width * (i + 1), levels_[level - 1].size()), box, depth, visit);
        }
    }
};

}  // namespace geomend
