// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/corner_point.h"

namespace geomend {

/// Layers of one number in FIPNUM, from 1.
struct FipLayers {
    std::uint32_t number = 1, first = 0, last = 0;  ///< layers from 0
};

/// A METRIC deck of oil and water over a grid that stands in an include: constant porosity and permeabilities, a contact in the middle of
/// the depths, one injector and one producer in columns that are wholly active (none, where there are no two such), half a year. As
/// OPM Flow takes it. Depths are in the grid's unit, which is feet where the grid says so. \pre a cell is active
std::string flow_deck(const CornerPointGrid& grid, const std::string& title, const std::string& include,
                      const std::vector<FipLayers>& layers);

}  // namespace geomend
