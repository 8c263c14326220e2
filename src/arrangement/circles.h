// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "arrangement/cut_round.h"

namespace geomend::arrangement {

/// Points next to a straight line leave a polygon between them of which each diagonal passes by another corner within reach: whichever is
/// drawn, the next look puts that corner on it and the other diagonal takes its place, and rounds go in circles. Here such a polygon is
/// triangles of one source, all new, joined by edges on which something was found. One that is thinner than twice the tolerance gives up
/// its area: all its corners become parts of one line, which what is around it bends to. A wider one gets a point in its middle, to which
/// all its corners are joined, so that it needs no diagonal. Adds to what was found; the points it makes keep their distance.
/// Cost: near-linear in new triangles and what was found.
/// \param tolerance in steps of the grid
void break_circles(CutState& state, NearFeatures& found, double tolerance);

}  // namespace geomend::arrangement
