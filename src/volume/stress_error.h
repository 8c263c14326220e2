// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "volume/tetrahedra.h"

namespace geomend::volumes {

/// Stress that a calculation with linear tetrahedra gave, the same all over each of them.
struct StressField {
    std::span<const Vec3> points;
    std::span<const std::array<std::uint32_t, 4>> cells;
    std::span<const std::array<double, 6>> stress;  ///< per cell three normal parts, then three shear parts
    std::span<const std::uint32_t> groups;          ///< per cell: stress may jump between cells of different ones; empty: all are of one
    std::span<const double> young;                  ///< per cell, above 0; empty: 1, as errors by energies do not depend on it
    double poisson = 0.25;                          ///< from 0 on, below a half
};

/// How far the stress of each cell is from one that changes steadily.
struct StressError {
    std::vector<double> by_own_energy;  ///< per cell the energy of the error by that of the cell, as lengths: eta
    std::vector<double> by_mean;        ///< per cell by what each cell may have for the whole to have the error that is allowed: xi
    std::vector<double> edges;          ///< per cell
    std::vector<double> wanted;         ///< per cell the length that edges should have: never more than now
    double whole = 0;                   ///< the error of the whole by its energy
    double largest = 0;                 ///< of by_own_energy, but of cells with almost no energy
    std::uint64_t above = 0;            ///< cells whose own error is more than allowed
    std::uint64_t without_energy =
        0;  ///< cells with less than a hundredth of the mean energy in their volume, whose own error says nothing
};

/// The error estimator of O. Zienkiewicz and J. Zhu (1987) as A. Botella (2016), section 5.2, has it: stress at nodes is the mean of the
/// cells around them (of one group), the error of a cell is the energy of what differs from it, and edges of a cell whose error is
/// xi > 1 times what it may be become shorter by it (linear shape functions). Where a cell's own error is more than allowed and xi is less,
/// that takes its place; no edge becomes shorter than a quarter at once.
/// \param allowed the error that is allowed, as a share, above 0 \pre cells of positive volume. Linear.
StressError stress_error(const StressField& field, double allowed);

/// The sizes at the points of cells: the least that a cell around a point wants.
std::vector<SizedPoint> sizes_at_points(const StressField& field, const StressError& error);

}  // namespace geomend::volumes
