// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "gridding/structure.h"

namespace geomend::gridding {

/// The line in the middle of a ring that is long and thin, from tip to tip: the tips are the two points of the ring farthest from each
/// other along it and across; the line lies midway between the two sides. Cost: square of the number of points.
/// \pre at least 3 points
Path centreline(const Path& ring);

/// Where a sheet meets the level `depth`: the pieces joined into the longest line. Empty where it does not reach that level.
Path level_line(const Sheet& sheet, double depth);

}  // namespace geomend::gridding
