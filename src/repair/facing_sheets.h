// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/triangle_soup.h"

// Sides that two bodies have in common, or surfaces that were given twice, with points of their own on each: once these are rounded, or
// where what is curved has other triangles, the two lie now on one side of each other and now on the other. They are one sheet, which a cut
// parts into slivers; a weld by a tolerance that is larger than what lies between them makes them one.

namespace geomend::repair {

/// A length within which sheets that run through each other at random are one.
struct SheetTolerance {
    double tolerance = 0;
    /// Something that always lies on one side of something else is no farther from it than that: it may be a thin layer, which would go.
    bool flattens = false;
    bool rounded = false;  ///< it is no more than a few steps to which all coordinates were rounded
};

/// The lengths at which sheets that face each other become one, ascending, at most three of one digit: from each on no more come
/// together until twice as far. Measured from the corners of each piece of a patch to the others within `near`.
/// \param tolerance what lies within it counts as one already  Cost: n log n, times the triangles within `near` of a corner.
std::vector<SheetTolerance> sheet_tolerances(const TriangleSoup& soup, double tolerance, double near);

}  // namespace geomend::repair
