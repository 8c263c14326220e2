// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/snap_grid.h"

#include <algorithm>
#include <cmath>

namespace geomend::arrangement {

namespace {

/// The largest power of two that is not above x. \pre x > 0
double power_of_two_below(double x) { return std::ldexp(1.0, std::ilogb(x)); }

}  // namespace

Vec3 SnapGrid::to_steps(const Vec3& position) const {
    Vec3 steps{};
    for (std::size_t k = 0; k < 3; ++k) steps[k] = std::nearbyint((position[k] - origin[k]) / step);
    return steps;
}

Vec3 SnapGrid::to_position(const Vec3& steps) const {
    Vec3 position{};
    for (std::size_t k = 0; k < 3; ++k) position[k] = origin[k] + steps[k] * step;
    return position;
}

SnapGrid snap_grid(std::span<const Vec3> points, double tolerance) {
    SnapGrid grid;
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Vec3& p : points) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    double extent = 0, largest = 0;
    for (std::size_t k = 0; k < 3 && !points.empty(); ++k) {
        extent = std::max(extent, high[k] - low[k]);
        largest = std::max({largest, std::abs(low[k]), std::abs(high[k])});
    }
    double step = power_of_two_below(tolerance / 512);
    if (largest > 0) step = std::max(step, power_of_two_below(largest) * 0x1p-51);
    if (extent > 0) step = std::max(step, power_of_two_below(extent) * 0x1p-37);
    grid.step = step;
    grid.tolerance_steps = std::max(1.0, tolerance / step);
    grid.is_fine = grid.tolerance_steps >= 16;
    for (std::size_t k = 0; k < 3 && !points.empty(); ++k) {
        grid.origin[k] = std::nearbyint((low[k] + 0.5 * (high[k] - low[k])) / step) * step;
    }
    return grid;
}

}  // namespace geomend::arrangement
