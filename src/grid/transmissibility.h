// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "base/result.h"
#include "grid/connections.h"

namespace geomend::grid {

/// Transmissibilities of all connections, in the deck's unit (cP rm3 / day bar, cP rb / day psi, ...).
struct Transmissibilities {
    std::vector<double> x, y, z;  ///< per cell, to the next cell in +I, +J and to the next active one below; else 0
    std::vector<double> others;   ///< one per Connections::others
};

/// Factor from permeability (mD) times length (METRIC m, FIELD ft, LAB cm) to the unit of transmissibility of a unit
/// system; METRIC where it is empty.
double transmissibility_factor(std::string_view unit_system);

/// Half-cell transmissibilities (NEWTRAN): of each cell the permeability of its direction times area vector dot d over
/// d squared, with d from the mean of the corners to the mean of the face's own four corners; net to gross on sides;
/// both halves in series; nothing flows down past cells without thickness unless the grid has PINCH, but always over bridges, with the area
/// of the upper cell. Then MULTX, MULTX-, ... (past further cells MULTZ of the upper one, or with PINCH(5) ALL the least), fault
/// multipliers and multipliers between regions (pairs that are not next to each other are NNC). Attributes PERMX (and PERMY, PERMZ, NTG,
/// MULT*, MULTNUM, FLUXNUM, OPERNUM where they are there) of cells are used; PERMY and PERMZ are PERMX where they are missing. The rules
/// are those of opm-simulators, so that its INIT has the same values. \pre connections = connections(grid), or that of its simulated cells.
/// The unit is that of grid.unit_system (lengths in another unit of the grid are converted); where no system is stated, that which goes
/// with the grid's unit of length. Errors: F007 where PERMX is missing.
Result<Transmissibilities> transmissibilities(const CornerPointGrid& grid, const Connections& connections);

/// Values of a cell attribute as doubles, missing ones as `fallback`; empty where there is no such attribute.
std::vector<double> cell_values(const CornerPointGrid& grid, std::string_view name, double fallback);

}  // namespace geomend::grid
