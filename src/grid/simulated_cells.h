// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/corner_point.h"

namespace geomend::grid {

/// Which cells a simulator keeps, and which it joins past those that it leaves out for their pore volume.
struct SimulatedCells {
    std::vector<std::uint8_t> present;                ///< per cell: as present_cells(), without those below
    std::vector<std::size_t> without_pores;           ///< active cells with thickness but no pore volume
    std::vector<std::size_t> below_minpv;             ///< active cells with a pore volume below MINPV (else MINPVV)
    std::vector<std::array<std::size_t, 2>> bridges;  ///< pairs of one column, upper cell first, ascending
};

/// The rules are those of flow 2022.10, found by running it. Without PORO and PORV, and in grids of two porosities, pore volumes are not
/// known and no cell is left out for them. Without MINPV and MINPVV no cell is left out but those without any pores. A cell below MINPV is
/// bridged, whatever its thickness and with or without PINCH: from the next kept cell above to the next kept one below.
/// Of cells that are inactive in the deck, or have no pores, those are passed whose mean thickness is within the threshold
/// of PINCH (0 without it), on the way down; on the way up those below it. The uppermost layer is looked at only right
/// above the cell that is left out. With NOGAP further cells below MINPV are passed only where they are thin; a single one is bridged all
/// the same. The largest gap and PINCH(4) change nothing. \pre misfit(grid) is empty. Cost: linear in cells where few are left out
SimulatedCells simulated_cells(const CornerPointGrid& grid);

}  // namespace geomend::grid
