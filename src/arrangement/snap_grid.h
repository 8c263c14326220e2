// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::arrangement {

/// A grid of points a power of two apart, on which a cut is made: positions are whole numbers of steps from an origin that
/// is itself a whole number of steps, so that differences of positions are exact in double, and a second cut finds the same grid.
struct SnapGrid {
    double step = 1;             ///< a power of two, in the unit of the coordinates
    Vec3 origin{};               ///< a multiple of the step, per coordinate
    double tolerance_steps = 1;  ///< the tolerance in steps
    bool is_fine = true;         ///< at least 16 steps in a tolerance: positions off the grid by half a step change no verdict

    /// The nearest point of the grid, in steps.
    Vec3 to_steps(const Vec3& position) const;
    /// Back to the unit of the coordinates; exact where the sum is a double.
    Vec3 to_position(const Vec3& steps) const;
};

/// The grid for some points: the tolerance has 512 to 1024 steps, fewer where the coordinates are so large that doubles are
/// not as fine, or where the extent would have more than 2^38 steps.
/// \param tolerance above 0, in the unit of the coordinates. \pre the points are finite. Cost: one pass.
SnapGrid snap_grid(std::span<const Vec3> points, double tolerance);

}  // namespace geomend::arrangement
