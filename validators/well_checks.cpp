// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/vectors.h"
#include "validators/cell_findings.h"
#include "validators/model_scope.h"
#include "validators/object_checks.h"

namespace geomend::validators {

namespace {

/// Positions and depths are often stored in single precision, rounded, or taken along the arc.
constexpr double rounding_of_depths = 1e-3;

double length_of_step(const Well& well, std::size_t station) {
    const Vec3 d = minus(well.path[station], well.path[station - 1]);
    return std::sqrt(dot(d, d));
}

/// A well with a measured depth for each station of its path; nullptr where the object is none.
const Well* surveyed_well(const ObjectScope& scope) {
    const auto* well = scope.as<Well>();
    return well != nullptr && !well->path.empty() && well->measured_depth.size() == well->path.size() ? well : nullptr;
}

void tell_stations(const ObjectScope& scope, std::string_view code, std::string_view what, std::span<const std::uint32_t> stations,
                   std::vector<Finding>& findings) {
    if (stations.empty()) return;
    Finding finding = object_finding(
        scope, code,
        counted(stations.size(), "station", "stations") + of_object(scope) + ": " + std::string(what) + "; the first one is station " +
            std::to_string(stations[0] + 1) +
            (surveyed_well(scope) != nullptr ? " at measured depth " + rounded(surveyed_well(scope)->measured_depth[stations[0]]) : ""));
    list_points(scope, stations, finding);
    findings.push_back(std::move(finding));
}

}  // namespace

void check_measured_depths(const ObjectScope& scope, std::vector<Finding>& findings) {
    const Well* well = surveyed_well(scope);
    if (well == nullptr) return;
    std::vector<std::uint32_t> back, too_little;
    for (std::uint32_t s = 1; s < well->path.size(); ++s) {
        const double length = length_of_step(*well, s), drilled = well->measured_depth[s] - well->measured_depth[s - 1];
        const double granted = scope.lengths().tolerance + rounding_of_depths * length;
        if (!(drilled > 0) && !(drilled == 0 && length <= scope.lengths().tolerance)) back.push_back(s);  // also where it is no number
        else if (drilled < length - granted) too_little.push_back(s);
    }
    tell_stations(scope, "M30", "the measured depth is not larger than at the station before", back, findings);
    tell_stations(scope, "M33", "the measured depth grows by less than the distance from the station before", too_little, findings);
}

void check_path_stops(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* well = scope.as<Well>();
    if (well == nullptr) return;
    std::vector<std::uint32_t> repeats;
    for (std::uint32_t s = 1; s < well->path.size(); ++s) {
        if (length_of_step(*well, s) <= scope.lengths().tolerance) repeats.push_back(s);
    }
    tell_stations(scope, "M31", "the path stays where it is", repeats, findings);
}

void check_along_path(const ObjectScope& scope, std::vector<Finding>& findings) {
    const Well* well = surveyed_well(scope);
    if (well == nullptr) return;
    const auto [shallowest, deepest] = std::ranges::minmax(well->measured_depth);
    const double granted = scope.lengths().tolerance + rounding_of_depths * (deepest - shallowest);
    const auto off = [&, low = shallowest - granted, high = deepest + granted](double depth) { return !(depth >= low && depth <= high); };
    std::vector<EntityRef> wrong;
    std::string first;
    const auto tell = [&](const char* kind, const std::string& name, double depth) {
        if (wrong.empty()) first = std::string(kind) + " " + quoted(name) + " at " + rounded(depth);
        wrong.push_back({kind, name});
    };
    for (const Well::Marker& marker : well->markers) {
        if (off(marker.measured_depth)) tell("marker", marker.name, marker.measured_depth);
    }
    for (const Well::Zone& zone : well->zones) {
        if (off(zone.from) || off(zone.to)) tell("zone", zone.name, off(zone.from) ? zone.from : zone.to);
        else if (zone.from > zone.to) tell("zone", zone.name, zone.from);
    }
    for (const Well::Curve& log : well->curves) {
        const auto at = std::ranges::find_if(log.measured_depth, off);
        if (at != log.measured_depth.end()) tell("log", log.values.name, *at);
    }
    if (wrong.empty()) return;
    Finding finding = object_finding(scope, "M32",
                                     counted(wrong.size(), "marker, zone or log", "markers, zones or logs") + of_object(scope) +
                                         (wrong.size() == 1 ? " is" : " are") + " off the path, or turned over: " + first +
                                         ", where the path runs from " + rounded(shallowest) + " to " + rounded(deepest));
    finding.count = wrong.size();
    wrong.resize(std::min(wrong.size(), listed_elements - 1));
    finding.entities.insert(finding.entities.end(), wrong.begin(), wrong.end());
    findings.push_back(std::move(finding));
}

void check_log_depths(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* well = scope.as<Well>();
    if (well == nullptr) return;
    std::vector<EntityRef> wrong;
    for (const Well::Curve& log : well->curves) {
        // Down or up, but one way.
        std::size_t down = 0, up = 0;
        for (std::size_t i = 1; i < log.measured_depth.size(); ++i) {
            down += log.measured_depth[i] > log.measured_depth[i - 1] ? 1 : 0;
            up += log.measured_depth[i] < log.measured_depth[i - 1] ? 1 : 0;
        }
        if (down > 0 && up > 0) wrong.push_back({"log", log.values.name});
    }
    if (wrong.empty()) return;
    Finding finding = object_finding(
        scope, "M34",
        counted(wrong.size(), "log", "logs") + of_object(scope) + ": depths go back and forth, first in " + quoted(wrong[0].name));
    finding.count = wrong.size();
    wrong.resize(std::min(wrong.size(), listed_elements - 1));
    finding.entities.insert(finding.entities.end(), wrong.begin(), wrong.end());
    findings.push_back(std::move(finding));
}

}  // namespace geomend::validators
