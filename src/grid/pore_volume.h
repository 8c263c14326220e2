// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "model/corner_point.h"

namespace geomend::grid {

/// Values of a cell attribute as cell_values() gives them; empty also where their number is wrong (C01 tells that).
std::vector<double> fitting_values(const CornerPointGrid& grid, std::string_view name, double fallback);

/// Whether the grid has porosities or pore volumes.
bool knows_pore_volumes(const CornerPointGrid& grid);

/// Pore volume of each cell in the unit of reservoir volume (METRIC rm3, FIELD rb, LAB rcc; without a unit system the
/// grid's own unit cubed): PORV where it is given, else volume times PORO, NTG and MULTPV. Missing values: PORO 0, NTG
/// and MULTPV 1. \pre knows_pore_volumes(grid)
std::vector<double> pore_volumes(const CornerPointGrid& grid);

/// MINPV, or 1e-6 where it is not stated, as simulators take it.
double least_pore_volume(const CornerPointGrid& grid);

}  // namespace geomend::grid
