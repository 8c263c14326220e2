// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/brep.h"

namespace geomend::topology {

/// Polygons whose turning would make a surface coherent, and whether no turning can.
struct Winding {
    std::vector<std::uint32_t> wrong;  ///< ascending; in each piece those that are fewer
    bool one_sided = false;
};

/// Follows a surface across its neighbours (which end at lines). Cost: linear.
/// \pre surface.neighbours is set
Winding winding_of(const BrepData::Surface& surface);

/// Turns a polygon over; it keeps its first corner. What is known of its edges holds no more.
void turn_polygon(BrepData::Surface& surface, std::uint32_t polygon);

}  // namespace geomend::topology
