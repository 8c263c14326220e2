// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "model/corner_point.h"

namespace geomend::validators {

/// The numbers that stand for "not set" among the depths of corners and among x and y of pillars of one grid.
struct UnsetValues {
    std::vector<double> depths, across;

    static bool holds(const std::vector<double>& unset, double v) {
        return std::ranges::any_of(unset, [&](double one) { return static_cast<float>(one) == static_cast<float>(v); });
    }
    /// Simulators take a coordinate of 1e20 or more for not set.
    static bool is_huge(double v) { return !(std::abs(v) < 1e20); }
    bool is_set_depth(double depth) const { return !is_huge(depth) && (depths.empty() || !holds(depths, depth)); }
    /// \param six x y z of its upper and of its lower point; their z may be anything, since pillars go on beyond their points
    bool is_set_pillar(const double* six) const {
        for (std::size_t k = 0; k < 6; ++k) {
            if (is_huge(six[k]) || (k % 3 != 2 && holds(across, six[k]))) return false;
        }
        return true;
    }
};

/// Finds them. A number of those that programs write for "no value" (-999.25, -99999, 1e10 and the like; 999 and 9999, too) is one
/// where it lies as far from all other depths of active cells as these do from each other, or farther, and fewer than half of their
/// corners have it (a tenth for 999 and 9999, at which some grids end). Of x and y the same, without 999 and 9999.
/// \param all_cells also the corners of inactive cells are looked at
/// Cost: linear, in parallel. \pre misfit(grid) is empty
UnsetValues unset_values(const CornerPointGrid& grid, bool all_cells);

}  // namespace geomend::validators
