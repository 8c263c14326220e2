// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "model/objects.h"

namespace geomend::repair {

/// What was done to a mesh of cells, and what was left.
struct CellCleaning {
    std::uint64_t merged = 0;    ///< nodes that became another one
    std::uint64_t turned = 0;    ///< cells that were inside out
    std::uint64_t repeated = 0;  ///< cells left out, since they used a node twice
    std::uint64_t flat = 0;      ///< cells left out, since they had no volume
    std::uint64_t doubles = 0;   ///< cells left out, since another one had the same nodes
    std::uint64_t unused = 0;    ///< nodes left out, since nothing used them
    std::uint64_t changes() const { return merged + turned + repeated + flat + doubles + unused; }
};

/// Cleans a mesh of cells: nodes within the tolerance of each other, but not equal, become one, so that the cells on both sides hang
/// together; nodes at one position stay two, since that is how cells are parted on purpose, as along faults. Cells that use a node
/// twice, have no volume or repeat another one are left out; cells whose nodes are ordered inside out (VTK's order) are turned.
/// Nodes that nothing uses any more are left out where the mesh states no aliases. Attributes,
/// sets, labels, entities and facet tags go with their cells and nodes. Cells below three dimensions stay.
/// \param tolerance above 0. Cost: n log n.
CellCleaning clean_cells(CellMesh& mesh, double tolerance);

/// For people; empty where nothing was done and nothing is left.
std::string cleaning_text(const CellCleaning& cleaning);

}  // namespace geomend::repair
