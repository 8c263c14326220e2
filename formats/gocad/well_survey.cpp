// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/well_survey.h"

#include <algorithm>
#include <cmath>

namespace geomend::gocad {

namespace {

Vec3 direction(const SurveyStation& s) {
    const double across = std::sin(s.inclination);
    return {across * std::sin(s.azimuth), across * std::cos(s.azimuth), -std::cos(s.inclination)};
}

}  // namespace

std::vector<Vec3> minimum_curvature(const Vec3& start, std::span<const SurveyStation> stations) {
    std::vector<Vec3> path;
    path.reserve(stations.size());
    for (std::size_t i = 0; i < stations.size(); ++i) {
        if (i == 0) {
            path.push_back(start);
            continue;
        }
        const Vec3 a = direction(stations[i - 1]);
        const Vec3 b = direction(stations[i]);
        const double cosine = std::clamp(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1.0, 1.0);
        const double dogleg = std::acos(cosine);
        // tan(x)/x is 1 to the last digit below this angle.
        const double ratio = dogleg < 1e-7 ? 1.0 : std::tan(dogleg / 2) / (dogleg / 2);
        const double half = (stations[i].measured_depth - stations[i - 1].measured_depth) / 2 * ratio;
        Vec3 p = path.back();
        for (std::size_t c = 0; c < 3; ++c) p[c] += half * (a[c] + b[c]);
        path.push_back(p);
    }
    return path;
}

}  // namespace geomend::gocad
