// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "model/corner_point.h"

namespace geomend::testing {

/// A grid of bricks of 100 x 100 x 10 between upright pillars, its top at depth 1000.
inline CornerPointGrid brick_grid(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
    CornerPointGrid grid;
    grid.info.name = "bricks";
    grid.info.crs.z_positive = ZPositive::depth;
    grid.dims = {nx, ny, nz};
    for (std::uint32_t j = 0; j <= ny; ++j) {
        for (std::uint32_t i = 0; i <= nx; ++i) {
            const double x = 100.0 * i, y = 100.0 * j;
            for (const double z : {1000.0, 1000.0 + 10.0 * nz}) grid.pillars.insert(grid.pillars.end(), {x, y, z});
        }
    }
    grid.depths.resize(8 * grid.cell_count());
    for (std::uint32_t k = 0; k < nz; ++k) {
        for (std::uint32_t j = 0; j < ny; ++j) {
            for (std::uint32_t i = 0; i < nx; ++i) {
                for (unsigned c = 0; c < 8; ++c) grid.depths[corner_index(grid.dims, i, j, k, c)] = 1000.0 + 10.0 * (k + (c >> 2));
            }
        }
    }
    return grid;
}

/// Moves all corners of some columns: change(i, j, c, depth) gives the new depth.
template <class Change>
void reshape(CornerPointGrid& grid, const Change& change) {
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
                for (unsigned c = 0; c < 8; ++c) {
                    double& depth = grid.depths[corner_index(grid.dims, i, j, k, c)];
                    depth = change(i, j, k, c, depth);
                }
            }
        }
    }
}

/// Lowers all columns from i = first on: a fault between columns first-1 and first.
inline void add_throw(CornerPointGrid& grid, std::uint32_t first, double distance) {
    reshape(grid,
            [&](std::uint32_t i, std::uint32_t, std::uint32_t, unsigned, double depth) { return i >= first ? depth + distance : depth; });
}

/// A cell attribute with the same value everywhere.
inline void add_constant(CornerPointGrid& grid, std::string name, double value) {
    Attribute a;
    a.name = std::move(name);
    a.location = AttributeLocation::cell;
    a.values = std::vector<double>(grid.cell_count(), value);
    grid.info.attributes.push_back(std::move(a));
}

}  // namespace geomend::testing
