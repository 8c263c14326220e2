// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/object_scope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/vectors.h"
#include "topology/thickness.h"
#include "validators/cell_findings.h"
#include "validators/model_scope.h"

namespace geomend::validators {

namespace {

constexpr double too_large = 1e20;  // programs write such numbers for "not set"

bool is_sound(const Vec3& p) {
    return std::ranges::all_of(p, [](double x) { return std::abs(x) < too_large; });
}

/// The samples at the corners of a raster, without heights.
std::vector<Vec3> outer_samples(const Raster& raster) {
    std::vector<Vec3> points;
    for (const std::uint32_t i : {0u, raster.dims[0] - 1}) {
        for (const std::uint32_t j : {0u, raster.dims[1] - 1}) {
            for (const std::uint32_t k : {0u, raster.dims[2] - 1}) points.push_back(sample_position(raster, i, j, k));
        }
    }
    return points;
}

/// The labels of the points, where the file has any.
const Labels* labels_of(const Object& object) {
    if (const auto* points = std::get_if<PointSet>(&object)) return &points->labels;
    if (const auto* lines = std::get_if<PolylineSet>(&object)) return &lines->labels;
    return nullptr;
}

/// The segments of lines and paths, by which their points count; of other objects none.
std::vector<std::array<Vec3, 2>> segments_of(const Object& object) {
    std::vector<std::array<Vec3, 2>> segments;
    if (const auto* lines = std::get_if<PolylineSet>(&object)) {
        for (const auto& [a, b] : lines->edges) segments.push_back({lines->points[a], lines->points[b]});
    } else if (const auto* well = std::get_if<Well>(&object)) {
        for (std::size_t i = 0; i + 1 < well->path.size(); ++i) segments.push_back({well->path[i], well->path[i + 1]});
    }
    return segments;
}

/// The centroid of lines by their lengths, so that it does not depend on how finely they are divided; else the mean of the points.
Vec3 centroid_of(std::span<const Vec3> points, std::span<const std::array<Vec3, 2>> segments) {
    Vec3 sum{};
    double weight = 0;
    for (const auto& [a, b] : segments) {
        const Vec3 along = minus(b, a);
        const double length = std::sqrt(dot(along, along));
        sum = plus(sum, times(0.5 * length, plus(minus(a, points[0]), minus(b, points[0]))));
        weight += length;
    }
    if (weight > 0) return plus(points[0], times(1 / weight, sum));
    sum = {};
    for (const Vec3& p : points) sum = plus(sum, minus(p, points[0]));
    return plus(points[0], times(1.0 / static_cast<double>(points.size()), sum));
}

/// Half of the length of the lines is in segments of at most this length; 0: there are none.
double median_length(std::span<const std::array<Vec3, 2>> segments) {
    std::vector<std::pair<double, double>> lengths;
    for (const auto& [a, b] : segments) {
        const Vec3 along = minus(b, a);
        const double length = std::sqrt(dot(along, along));
        if (length > 0) lengths.emplace_back(length, length);
    }
    return lengths.empty() ? 0 : topology::weighted_quantile(lengths, 0.5);
}

Lengths lengths_of(const Object& object, std::span<const Vec3> points, const CheckOptions& options) {
    Lengths lengths;
    const ObjectInfo& info = info_of(object);
    const bool single = info.precision == CoordinatePrecision::single_precision;
    const auto segments = segments_of(object);
    double step = 0;
    if (!points.empty()) {
        const Vec3 middle = centroid_of(points, segments);
        double farthest = 0;
        for (const Vec3& p : points) {
            const Vec3 d = minus(p, middle);
            farthest = std::max(farthest, dot(d, d));
            for (std::size_t k = 0; k < 3; ++k) step = std::max(step, step_above(std::abs(p[k] - info.stored_around[k]), single));
        }
        lengths.diameter = 2 * std::sqrt(farthest);
    }
    lengths.tolerance = options.tolerance >= 0 ? options.tolerance : std::max(1e-7 * lengths.diameter, 4 * step);
    double near = 1e-3 * lengths.diameter;
    if (const double edge = median_length(segments); edge > 0) near = std::min(near, edge / 4);
    lengths.near = options.near >= 0 ? options.near : std::max(10 * lengths.tolerance, near);
    return lengths;
}

}  // namespace

ObjectScope::ObjectScope(const Object& object, const CheckOptions& options) : object_(object), monitor_(options.monitor) {
    if (const auto* points = as<PointSet>()) points_ = points->points;
    else if (const auto* lines = as<PolylineSet>()) points_ = lines->points;
    else if (const auto* lattice = as<StructuredGrid>()) points_ = lattice->points;
    else if (const auto* well = as<Well>()) points_ = well->path;
    else if (const auto* raster = as<Raster>()) {
        own_points_ = outer_samples(*raster);
        points_ = own_points_;
    }
    if (std::ranges::all_of(points_, is_sound)) lengths_ = lengths_of(object, points_, options);
}

bool is_judged_alone(const Object& object) {
    if (const auto* well = std::get_if<Well>(&object)) return !well->path.empty();
    return std::holds_alternative<PointSet>(object) || std::holds_alternative<PolylineSet>(object) ||
           std::holds_alternative<StructuredGrid>(object) || std::holds_alternative<Raster>(object);
}

std::vector<Finding> huge_coordinates(const ObjectScope& scope) {
    std::vector<std::uint32_t> huge;
    for (std::uint32_t p = 0; p < scope.points().size(); ++p) {
        if (!is_sound(scope.points()[p])) huge.push_back(p);
    }
    if (huge.empty()) return {};
    Finding finding = object_finding(scope, "M09",
                                     counted(huge.size(), "point", "points") + of_object(scope) + (huge.size() == 1 ? " has" : " have") +
                                         " a coordinate that is not finite or as large as 1e20: it was not judged");
    list_points(scope, huge, finding);
    return {finding};
}

Finding object_finding(const ObjectScope& scope, std::string_view code, std::string message) {
    Finding finding = finding_of(code, std::move(message));
    finding.entities.push_back({kind_name(scope.object()), scope.info().name});
    return finding;
}

void list_points(const ObjectScope& scope, std::span<const std::uint32_t> points, Finding& finding) {
    const Labels* labels = labels_of(scope.object());
    finding.element_kind = "point";
    finding.count = points.size();
    for (const std::uint32_t p : points.first(std::min(points.size(), listed_elements))) {
        finding.elements.push_back(labels != nullptr ? (*labels)[p] : static_cast<std::int64_t>(p) + 1);
        finding.index.push_back(p);
        finding.points.push_back(scope.points()[p]);
    }
}

std::string of_object(const ObjectScope& scope) { return scope.info().name.empty() ? "" : " of " + quoted(scope.info().name); }

}  // namespace geomend::validators
