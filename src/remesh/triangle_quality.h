// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/vec3.h"

namespace geomend::remeshing {

/// Shapes of some triangles. Quality is twice the radius of the circle in a triangle by that of the circle around it: 1 where it is
/// equilateral, 0 where it has no area. So is the shape that J. Pellerin (2014) measures: 6 areas by the longest edge, half the sum of the
/// edges, and the root of 3.
struct TriangleQuality {
    std::uint64_t triangles = 0, above_30 = 0;  ///< above: all of whose angles are at least 30 degrees
    std::uint64_t between_lines = 0;            ///< of those that are not above: all whose corners lie on lines, which force the angle
    double least_angle = 180;                   ///< degrees
    double sum_quality = 0, sum_shape = 0;
    std::uint64_t small_angles = 0;  ///< of all three of each: below 30 degrees

    void add(const std::array<Vec3, 3>& triangle, bool is_between_lines = false);
    void add(const TriangleQuality& other) {
        triangles += other.triangles;
        above_30 += other.above_30;
        between_lines += other.between_lines;
        least_angle = std::min(least_angle, other.least_angle);
        sum_quality += other.sum_quality;
        sum_shape += other.sum_shape;
        small_angles += other.small_angles;
    }
    double share_above_30() const { return triangles > 0 ? static_cast<double>(above_30) / static_cast<double>(triangles) : 0; }
    double share_of_small_angles() const {
        return triangles > 0 ? static_cast<double>(small_angles) / (3 * static_cast<double>(triangles)) : 0;
    }
    double mean_shape() const { return triangles > 0 ? sum_shape / static_cast<double>(triangles) : 0; }
    double mean_quality() const { return triangles > 0 ? sum_quality / static_cast<double>(triangles) : 0; }
};

}  // namespace geomend::remeshing
