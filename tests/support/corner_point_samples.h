// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>

#include "model/corner_point.h"

namespace geomend::test {

/// A grid with a fault between i = nx/2 - 1 and nx/2, leaning pillars, gaps below every third layer where asked, and an
/// inactive cell; all numbers are exact in single precision.
inline CornerPointGrid faulted_grid(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz, bool gaps = false) {
    CornerPointGrid grid;
    grid.info.name = "faulted";
    grid.dims = {nx, ny, nz};
    grid.info.crs.z_positive = ZPositive::depth;
    grid.info.crs.z_positive_stated = true;
    grid.info.precision = CoordinatePrecision::single_precision;
    for (std::uint32_t j = 0; j <= ny; ++j) {
        for (std::uint32_t i = 0; i <= nx; ++i) {
            const double x = 100.0 * i, y = 80.0 * j;
            grid.pillars.insert(grid.pillars.end(), {x, y, 1000, x + 8, y - 4, 2024});
        }
    }
    grid.depths.resize(8 * grid.cell_count());
    for (std::uint32_t k = 0; k < nz; ++k) {
        for (std::uint32_t j = 0; j < ny; ++j) {
            for (std::uint32_t i = 0; i < nx; ++i) {
                for (unsigned c = 0; c < 8; ++c) {
                    const std::uint32_t pi = i + (c & 1u), pj = j + (c >> 1 & 1u), pk = k + (c >> 2);
                    double z = 1200 + 12.0 * pk + 0.5 * pi + 0.25 * (pj % 3);
                    if (i >= nx / 2) z += 17.5;
                    if (gaps && c >= 4 && k % 3 == 2) z -= 1.5;
                    grid.depths[corner_index(grid.dims, i, j, k, c)] = z;
                }
            }
        }
    }
    grid.activity.assign(grid.cell_count(), 1);
    if (grid.cell_count() > 1) grid.activity[1] = 0;
    return grid;
}

}  // namespace geomend::test
