// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/cell_geometry.h"

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "geometry/cell_volume.h"

namespace geomend::grid {

namespace {

constexpr std::size_t block = 4096;

// A sector of a ring, between the mean top and the mean bottom.
double ring_volume(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    const double* set = grid.pillars.data() + 6 * pillar_count(grid.dims) * (grid.reservoirs.empty() ? 0 : pillar_set(grid, k));
    const double* inner = set + 6 * (i + lines * j);
    const double* outer = inner + 6;
    const double* next = inner + 6 * lines;
    double height = 0;
    for (unsigned c = 0; c < 8; ++c) height += (c < 4 ? -0.25 : 0.25) * grid.depths[corner_index(grid.dims, i, j, k, c)];
    const double angle = (next[1] - inner[1]) * std::numbers::pi / 180;
    return 0.5 * (outer[0] * outer[0] - inner[0] * inner[0]) * angle * height;
}

// Calls body(cell, signed volume) for each cell of a block.
template <class Body>
void each_volume(const CornerPointGrid& grid, std::size_t first, std::size_t last, bool only_active, const Body& body) {
    auto [i, j, k] = grid.ijk(first);
    for (std::size_t cell = first; cell < last; ++cell) {
        if (!only_active || grid.is_active(cell)) body(cell, cell_volume(grid, i, j, k));
        if (++i < grid.dims[0]) continue;
        i = 0;
        if (++j < grid.dims[1]) continue;
        j = 0;
        ++k;
    }
}

// Derivative of the trilinear map along one axis; the weights are those of the other two.
Vec3 edge_mean(const Corners& p, unsigned axis, double s, double t) {
    const unsigned step = 1u << axis, a = 1u << ((axis + 1) % 3), b = 1u << ((axis + 2) % 3);
    Vec3 sum{};
    for (unsigned q = 0; q < 4; ++q) {
        const unsigned c = ((q & 1u) != 0 ? a : 0) + ((q & 2u) != 0 ? b : 0);
        const double weight = ((q & 1u) != 0 ? s : 1 - s) * ((q & 2u) != 0 ? t : 1 - t);
        for (std::size_t d = 0; d < 3; ++d) sum[d] += weight * (p[c + step][d] - p[c][d]);
    }
    return sum;
}

Vec3 trilinear(const Corners& p, double u, double v, double w) {
    Vec3 sum{};
    for (unsigned c = 0; c < 8; ++c) {
        const double weight = ((c & 1u) != 0 ? u : 1 - u) * ((c & 2u) != 0 ? v : 1 - v) * ((c & 4u) != 0 ? w : 1 - w);
        for (std::size_t d = 0; d < 3; ++d) sum[d] += weight * (p[c][d] - p[0][d]);
    }
    return sum;
}

}  // namespace

double cell_volume(const Corners& p) { return hexahedron_volume({p[0], p[1], p[3], p[2], p[4], p[5], p[7], p[6]}); }

double cell_volume(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return grid.cylindrical ? ring_volume(grid, i, j, k) : cell_volume(cell_corners(grid, i, j, k));
}

std::vector<double> cell_volumes(const CornerPointGrid& grid) {
    std::vector<double> volumes(grid.cell_count());
    parallel_blocks(volumes.size(), block, [&](std::size_t first, std::size_t last) {
        each_volume(grid, first, last, false, [&](std::size_t cell, double v) { volumes[cell] = v; });
    });
    return volumes;
}

double volume(const CornerPointGrid& grid) {
    const std::size_t cells = grid.cell_count();
    std::vector<double> sums((cells + block - 1) / block, 0.0);
    parallel_for_each_index(sums.size(), [&](std::size_t b) {
        each_volume(grid, b * block, std::min(cells, (b + 1) * block), true, [&](std::size_t, double v) { sums[b] += std::abs(v); });
    });
    double total = 0;
    for (const double s : sums) total += s;
    return total;
}

Vec3 centre(const Corners& corners) {
    Vec3 sum{};
    for (const Vec3& p : corners) {
        for (std::size_t d = 0; d < 3; ++d) sum[d] += p[d];
    }
    return {sum[0] / 8, sum[1] / 8, sum[2] / 8};
}

double thickness(const Corners& p) { return (p[4][2] + p[5][2] + p[6][2] + p[7][2] - p[0][2] - p[1][2] - p[2][2] - p[3][2]) / 4; }

Vec3 centroid(const Corners& corners) {
    // Exact: position times determinant has degree 3 in each variable, two points a direction would do for that;
    // three keep the error small where the cell is nearly flat.
    const double offset = std::sqrt(0.6) / 2;
    const std::array<double, 3> at{0.5 - offset, 0.5, 0.5 + offset}, weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
    double mass = 0;
    Vec3 sum{};
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double m = weight[a] * weight[b] * weight[c] * jacobian(corners, at[a], at[b], at[c]);
                const Vec3 p = trilinear(corners, at[a], at[b], at[c]);
                mass += m;
                for (std::size_t d = 0; d < 3; ++d) sum[d] += m * p[d];
            }
        }
    }
    if (mass == 0) return centre(corners);
    return {corners[0][0] + sum[0] / mass, corners[0][1] + sum[1] / mass, corners[0][2] + sum[2] / mass};
}

double jacobian(const Corners& p, double u, double v, double w) {
    return dot(edge_mean(p, 0, v, w), cross(edge_mean(p, 1, w, u), edge_mean(p, 2, u, v)));
}

std::array<double, 8> corner_jacobians(const Corners& corners) {
    std::array<double, 8> all;
    for (unsigned c = 0; c < 8; ++c) all[c] = jacobian(corners, c & 1u, (c >> 1) & 1u, c >> 2);
    return all;
}

}  // namespace geomend::grid
