// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "hexes/candidates.h"

namespace geomend::hexes {

/// How many quadrangles of a candidate are hard to close towards tetrahedra, or cannot be closed: such a candidate can only stand where
/// another one has the same quadrangle.
struct UnclosableCounts {
    std::uint8_t in_fan = 0;  ///< the tetrahedra around its diagonal leave no room for an apex; with others there may be some
    std::uint8_t at_all = 0;  ///< walls leave none
};
/// For each candidate. Cost: 2 microseconds for each quadrangle that two facets make, more for those that cannot be closed.
std::vector<UnclosableCounts> count_unclosable(const TetMesh& mesh, const Candidates& candidates);

}  // namespace geomend::hexes
