// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// Triangles of a patch that lay in another one and were left out.
struct LeftOverlap {
    std::uint32_t kept = 0, left_out = 0;  ///< patches
    std::uint64_t triangles = 0;
    bool whole = false;  ///< nothing is left of the patch
};

/// Leaves out triangles of two patches on the same three vertices, all but one: what a cut makes of surfaces that lie on each other.
/// Parts that overlap are looked at as a whole: that stays which hangs together with more of its own patch around it; of those
/// alike in that the boundary stays, then the fault, then the larger patch, then the first one.
/// Patches of which nothing is left are marked in `model.lies_in`, and listed as a loss of identity.
/// \pre the soup is cut  \return by patches, ascending. Cost: n log n.
std::vector<LeftOverlap> leave_out_overlaps(SurfaceModel& model);

}  // namespace geomend::repair
