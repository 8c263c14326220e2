// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::gocad {

/// One station of a deviation survey: measured depth, inclination from the vertical and azimuth from north, both in
/// radians.
struct SurveyStation {
    double measured_depth = 0;
    double inclination = 0;
    double azimuth = 0;
};

/// Positions of the stations by the minimum curvature method: between two stations the path is the arc of a circle.
/// \param start position of the first station, elevation-up
std::vector<Vec3> minimum_curvature(const Vec3& start, std::span<const SurveyStation> stations);

}  // namespace geomend::gocad
