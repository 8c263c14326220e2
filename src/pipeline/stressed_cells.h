// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/dataset.h"

namespace geomend {

/// The tetrahedra of a result of a calculation, those of all its blocks, with their stress.
struct StressedCells {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> cells;
    std::vector<std::array<double, 6>> stress;  ///< as it is in the file
    std::vector<std::uint32_t> groups;          ///< per cell, its block and region: stress may jump between them
    std::vector<double> young;                  ///< per cell; empty where no block has them
    std::string property;                       ///< the name of the stress
};

/// Takes six (or, as a whole symmetric matrix, nine) components of stress for each tetrahedron: the property called stress or S, or the
/// only one with as many components. The property young, where there is one, is the modulus of each cell.
/// Failure (cannot_hold, F026, with the measure no_stress) where a block with cells has no such property, has other cells than
/// tetrahedra of first order, or has values that are none. Cost: linear.
Result<StressedCells> stressed_cells(const Dataset& dataset, const std::string& file);

/// The failure of a result that says nothing about sizes.
Failure no_stress(const std::string& file, const std::string& why);

}  // namespace geomend
