// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "model/objects.h"

namespace geomend::test {

/// A deck around a grid include, with rock that varies from cell to cell.
struct FlowCase {
    std::filesystem::path folder;
    std::array<std::uint32_t, 3> dims;
    std::string grid_section;    ///< further text of the grid section, behind the rock
    bool constant_rock = false;  ///< PORO 0.2, PERM 200/20 everywhere
    std::string rock = {};       ///< text in place of that, where it is not empty
};

bool has_flow();

/// Writes CASE.DATA and ROCK.INC into the folder; the deck includes GRID.GRDECL, which must stand there.
void write_deck(const FlowCase& c);

/// Runs `flow --enable-dry-run=true` in the folder; false where it stops or writes no INIT.
bool dry_run(const FlowCase& c);

/// The grid with the properties of the simulator's own files (EGRID and INIT), as geomend reads them.
CornerPointGrid simulated(const FlowCase& c);
/// The grid of the deck.
CornerPointGrid of_deck(const FlowCase& c);

/// Connections as unordered pairs of cells with their transmissibilities.
using Pairs = std::map<std::pair<std::uint64_t, std::uint64_t>, double>;

/// Values of an attribute; fails the test where it is missing.
std::vector<double> values(const CornerPointGrid& grid, const std::string& name);

}  // namespace geomend::test
