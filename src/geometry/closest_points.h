// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "base/vec3.h"

namespace geomend {

/// The closest points of two things, and their distance.
struct Closest {
    double distance = 0;
    Vec3 on_first{}, on_second{};
    Vec3 apart{};  ///< from on_first to on_second, without their rounding far from the origin
    /// The corners of the smallest part that has the point: bit i for corner i. One: the corner itself, to the bit; two: inside an
    /// edge; three: inside the triangle.
    unsigned first_part = 0, second_part = 0;
};

// In plain arithmetic relative to the first corner of the triangle: errors of some 1e-16 of the sizes and distances at hand, and
// the rounding of the points found. All may be degenerate. \pre finite. Cost: 30 ns to 0.5 microseconds.

Closest closest_points(const Vec3& point, const std::array<Vec3, 3>& triangle);

/// The distance is 0 exactly where they have a point in common.
Closest closest_points(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle);

/// \pre they have no point in common, be it known from meeting()
Closest closest_points(const std::array<Vec3, 3>& first, const std::array<Vec3, 3>& second);

/// Whether a segment and a triangle have a point in common: exact (range of coordinates: see predicates.h).
/// \pre the triangle is not degenerate
bool meets(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle);

}  // namespace geomend
