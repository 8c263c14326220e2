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

namespace {

// A pillar as points on it are worked out: many corners of cells are, so that nothing is done twice.
struct PillarLine {
    double x, y, z, dx, dy, dz;
    explicit PillarLine(const double* p) : x(p[0]), y(p[1]), z(p[2]), dx(p[3] - p[0]), dy(p[4] - p[1]), dz(p[5] - p[2]) {}
    Vec3 at(double depth) const {
        if (dz == 0) return {x, y, depth};
        const double t = (depth - z) / dz;
        return {x + t * dx, y + t * dy, depth};
    }
};

Vec3 unrolled(const Vec3& p) {
    const double angle = p[1] * std::numbers::pi / 180;
    return {p[0] * std::cos(angle), p[0] * std::sin(angle), p[2]};
}

}  // namespace

Vec3 pillar_point(const double* pillar, double depth, bool cylindrical) {
    const Vec3 at = PillarLine(pillar).at(depth);
    return cylindrical ? unrolled(at) : at;
}

std::array<Vec3, 8> cell_corners(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    const double* pillars = grid.pillars.data() + 6 * pillar_count(grid.dims) * (grid.reservoirs.empty() ? 0 : pillar_set(grid, k));
    const double* pillar = pillars + 6 * (i + lines * j);
    const double* top = grid.depths.data() + corner_index(grid.dims, i, j, k, 0);
    const std::size_t row = 2 * std::size_t{grid.dims[0]}, bottom = 2 * row * grid.dims[1];
    std::array<Vec3, 8> corners;
    for (unsigned c = 0; c < 4; ++c) {
        const PillarLine line(pillar + 6 * ((c & 1u) + (c >> 1 != 0 ? lines : 0)));
        const double* depth = top + (c & 1u) + (c >> 1 != 0 ? row : 0);
        corners[c] = line.at(depth[0]);
        corners[c + 4] = line.at(depth[bottom]);
    }
    if (grid.cylindrical) std::ranges::transform(corners, corners.begin(), unrolled);
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
