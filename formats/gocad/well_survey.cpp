// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/well_survey.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text_cursor.h"

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

SurveyedPath surveyed_path(const Vec3& start, std::vector<SurveyStation> stations) {
    SurveyedPath path;
    if (stations.empty()) return path;
    for (const SurveyStation& s : stations) path.measured_depth.push_back(s.measured_depth);
    const bool starts_below = stations.front().measured_depth > 0;
    if (starts_below) stations.insert(stations.begin(), SurveyStation{});
    path.points = minimum_curvature(start, stations);
    if (starts_below) path.points.erase(path.points.begin());
    return path;
}

bool parse_station(std::string_view text, SurveyStation& station) {
    TextCursor line(text);
    line.next_line();
    if (line.token() != "STATION") return false;
    constexpr double degree = std::numbers::pi / 180;
    double inclination = 0, azimuth = 0;
    if (line.real(station.measured_depth) != NumberStatus::ok || line.real(inclination) != NumberStatus::ok ||
        line.real(azimuth) != NumberStatus::ok) {
        return false;
    }
    station.inclination = inclination * degree;
    station.azimuth = azimuth * degree;
    return true;
}

}  // namespace geomend::gocad
