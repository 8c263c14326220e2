// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>
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

/// The path that a survey gives: a point and a measured depth for each station.
struct SurveyedPath {
    std::vector<Vec3> points;
    std::vector<double> measured_depth;
};

/// The survey starts at `start` (elevation-up); where its first station is deeper, the way to it starts vertically there.
SurveyedPath surveyed_path(const Vec3& start, std::vector<SurveyStation> stations);

/// `STATION md incl azim`, angles in degrees. \return false where the text is something else
bool parse_station(std::string_view text, SurveyStation& station);

/// Positions of the stations by the minimum curvature method: between two stations the path is the arc of a circle.
/// \param start position of the first station, elevation-up
std::vector<Vec3> minimum_curvature(const Vec3& start, std::span<const SurveyStation> stations);

}  // namespace geomend::gocad
