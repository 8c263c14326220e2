// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "arrangement/cut_round.h"
#include "model/triangle_soup.h"

namespace geomend::arrangement {

/// Where edges bend towards points that are near them, a piece thinner than the tolerance may fold over: it faces away from the triangle
/// that it is a piece of. The corner of such a piece becomes a part of its longest edge, so that the piece is gone and
/// its neighbour across the edge bends by less than the tolerance. False where there is none, and nothing changed. Cost: linear.
/// \param soup what is being cut \param tolerance in steps of the grid
bool unfold(CutState& state, const TriangleSoup& soup, double tolerance);

}  // namespace geomend::arrangement
