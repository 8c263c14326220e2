// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "validators/cell_scope.h"

namespace geomend::validators {

/// M37: regions whose cells neither common faces nor faces that lie on each other join. Regions are the entities of the mesh; where
/// it has none, the values of an array of whole numbers that is called after regions or materials.
/// \param facing pairs of cells with outer faces that lie on each other
/// Cost: near-linear.
void check_cell_regions(const CellScope& scope, std::span<const std::array<std::uint32_t, 2>> facing, std::vector<Finding>& findings);

}  // namespace geomend::validators
