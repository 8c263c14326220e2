// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/vectors.h"
#include "validators/object_checks.h"

namespace geomend::validators {

namespace {

/// Axes along which a raster has more than one sample.
std::vector<std::size_t> used_axes(const Raster& raster) {
    std::vector<std::size_t> axes;
    for (std::size_t a = 0; a < 3; ++a) {
        if (raster.dims[a] > 1) axes.push_back(a);
    }
    return axes;
}

/// The direction of an axis, of length 1; null where its step is.
Vec3 direction(const Raster& raster, std::size_t axis) {
    const Vec3& step = raster.step[axis];
    const double largest = std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
    if (!(largest > 0)) return {};
    const Vec3 scaled = times(1 / largest, step);
    return times(1 / std::sqrt(dot(scaled, scaled)), scaled);
}

constexpr char axis_names[] = {'U', 'V', 'W'};

/// How independent the used axes are: 1 where they are square to each other, 0 where one follows from the others.
double independence(const std::vector<Vec3>& directions) {
    if (directions.size() == 3) return std::abs(dot(directions[0], cross(directions[1], directions[2])));
    if (directions.size() < 2) return 1;
    const Vec3 n = cross(directions[0], directions[1]);
    return std::sqrt(dot(n, n));
}

bool turns_left(const Raster& raster, const std::vector<std::size_t>& axes, const std::vector<Vec3>& directions) {
    if (!raster.coordinates[0].empty()) {
        std::size_t descending = 0;
        for (const std::size_t a : axes) descending += raster.coordinates[a].back() < raster.coordinates[a].front() ? 1 : 0;
        return descending % 2 == 1;
    }
    if (axes.size() == 3) return dot(directions[0], cross(directions[1], directions[2])) < 0;
    // A map: seen from above.
    return axes.size() == 2 && axes[1] == 1 && cross(directions[0], directions[1])[2] < 0;
}

/// What is wrong with the axes; empty where nothing is.
std::string wrong_axes(const Raster& raster, const std::vector<std::size_t>& axes, const std::vector<Vec3>& directions) {
    constexpr double least = 1e-9;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const std::size_t a = axes[k];
        const std::string axis(1, axis_names[a]);
        if (raster.coordinates[0].empty()) {
            if (dot(directions[k], directions[k]) == 0) return "the step along axis " + axis + " is zero";
            continue;
        }
        const std::vector<double>& x = raster.coordinates[a];
        const double sign = x.back() < x.front() ? -1 : 1;
        for (std::size_t i = 1; i < x.size(); ++i) {
            if (!(sign * x[i] > sign * x[i - 1]))
                return "coordinates along axis " + axis + " stand still or turn back at sample " + std::to_string(i + 1);
        }
    }
    if (raster.coordinates[0].empty() && independence(directions) < least) return "its axes depend on each other";
    return {};
}

}  // namespace

void check_raster_axes(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* raster = scope.as<Raster>();
    if (raster == nullptr) return;
    const auto axes = used_axes(*raster);
    std::vector<Vec3> directions;
    for (const std::size_t a : axes) directions.push_back(direction(*raster, a));
    if (const std::string wrong = wrong_axes(*raster, axes, directions); !wrong.empty()) {
        findings.push_back(object_finding(scope, "M40", "the axes" + of_object(scope) + " do not span a raster: " + wrong));
        findings.back().count = 1;
    } else if (turns_left(*raster, axes, directions)) {
        findings.push_back(object_finding(
            scope, "M41", "the axes" + of_object(scope) + " are left-handed" + (axes.size() == 2 ? " seen from above" : "")));
        findings.back().count = 1;
    }
}

}  // namespace geomend::validators
