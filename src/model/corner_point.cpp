// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/corner_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geomend {

std::size_t pillar_set(const CornerPointGrid& grid, std::uint32_t k) {
    for (std::size_t r = 0; r < grid.reservoirs.size(); ++r) {
        if (k >= grid.reservoirs[r].first_layer && k <= grid.reservoirs[r].last_layer) return r;
    }
    return 0;
}

Vec3 pillar_point(const double* pillar, double depth, bool cylindrical) {
    double x = pillar[0], y = pillar[1];
    if (const double height = pillar[5] - pillar[2]; height != 0) {
        const double t = (depth - pillar[2]) / height;
        x += t * (pillar[3] - pillar[0]);
        y += t * (pillar[4] - pillar[1]);
    }
    if (!cylindrical) return {x, y, depth};
    const double angle = y * std::numbers::pi / 180;
    return {x * std::cos(angle), x * std::sin(angle), depth};
}

std::array<Vec3, 8> cell_corners(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    const double* pillars = grid.pillars.data() + 6 * pillar_count(grid.dims) * (grid.reservoirs.empty() ? 0 : pillar_set(grid, k));
    std::array<Vec3, 8> corners;
    for (unsigned c = 0; c < 8; ++c) {
        const std::size_t pillar = i + (c & 1u) + lines * (std::size_t{j} + ((c >> 1) & 1u));
        corners[c] = pillar_point(pillars + 6 * pillar, grid.depths[corner_index(grid.dims, i, j, k, c)], grid.cylindrical);
    }
    return corners;
}

std::size_t active_count(const CornerPointGrid& grid) {
    if (grid.activity.empty()) return grid.cell_count();
    return static_cast<std::size_t>(std::ranges::count_if(grid.activity, [](std::uint8_t a) { return a != 0; }));
}

std::string misfit(const CornerPointGrid& grid) {
    const auto wrong = [](const char* what, std::size_t expected, std::size_t found) {
        return std::string(what) + ": expected " + std::to_string(expected) + " values, found " + std::to_string(found);
    };
    const std::size_t lines = 6 * pillar_count(grid.dims) * std::max<std::size_t>(1, grid.reservoirs.size());
    if (grid.pillars.size() != lines) return wrong("pillars", lines, grid.pillars.size());
    if (grid.depths.size() != 8 * grid.cell_count()) return wrong("corner depths", 8 * grid.cell_count(), grid.depths.size());
    if (!grid.activity.empty() && grid.activity.size() != grid.cell_count())
        return wrong("activity", grid.cell_count(), grid.activity.size());
    return {};
}

}  // namespace geomend
