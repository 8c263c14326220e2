// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/corner_point.h"

namespace geomend {

/// Layers of one number in FIPNUM, from 1.
struct FipLayers {
    std::uint32_t number = 1, first = 0, last = 0;  ///< layers from 0
};

/// Makes the attributes of a grid such that a deck runs: cells without porosity or permeability get values, regions of tables are taken
/// off, FIPNUM too, which the deck states itself. Notes say what was changed.
std::vector<std::string> fit_for_deck(CornerPointGrid& grid);

/// The non-neighbour connections that a simulator has of such a deck: without those whose transmissibility is next to nothing.
/// Failure as of compute_connections().
Result<std::uint64_t> connections_in_deck(const CornerPointGrid& grid);

/// A METRIC deck of oil and water over a grid that stands in an include: porosity and permeabilities of the grid, or constant, a contact
/// in the middle of the depths, one injector in the lowest and one producer in the uppermost layer of columns that are wholly active
/// (none, where there are no two such), half a year. As OPM Flow takes it. Depths are in the grid's unit, which is feet where the grid says
/// so. \pre a cell is active
std::string flow_deck(const CornerPointGrid& grid, const std::string& title, const std::string& include,
                      const std::vector<FipLayers>& layers);

}  // namespace geomend
