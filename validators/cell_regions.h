// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "validators/cell_scope.h"

namespace geomend::validators {

/// Per cell of a mesh the region that the file states for it, by entities or an array called after regions; empty where it states none.
/// Cells in none have a number of their own. Cost: linear.
std::vector<std::int64_t> stated_regions_of_cells(const CellScope& scope);

/// M37: regions whose cells neither common faces nor faces that lie on each other join. Regions are the entities of the mesh; where
/// it has none, the values of an array of whole numbers that is called after regions or materials.
/// \param facing pairs of cells with outer faces that lie on each other
/// Cost: near-linear.
void check_cell_regions(const CellScope& scope, std::span<const std::array<std::uint32_t, 2>> facing, std::vector<Finding>& findings);

}  // namespace geomend::validators
