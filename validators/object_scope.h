// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/finding.h"
#include "model/objects.h"
#include "validators/grid_scope.h"

namespace geomend::validators {

/// An object that is judged by itself: a point set, polylines, a structured grid, a raster or a well.
class ObjectScope {
public:
    /// The object outlives the scope. Cost: linear in its points.
    ObjectScope(const Object& object, const CheckOptions& options);

    const Object& object() const { return object_; }
    /// The object where it is of a kind, or nullptr.
    template <class Kind>
    const Kind* as() const {
        return std::get_if<Kind>(&object_);
    }
    const ObjectInfo& info() const { return info_of(object_); }
    /// By which it is judged, by the rules of local_lengths(): D is twice the largest distance of one of its points from the centroid,
    /// of lines and paths weighted by length; the median edge is that of lines and paths.
    const Lengths& lengths() const { return lengths_; }
    /// Its points: of a well those of the path, of a raster its outermost samples.
    std::span<const Vec3> points() const { return points_; }
    bool stopped() const { return monitor_ != nullptr && monitor_->stopped(); }

private:
    const Object& object_;
    const Monitor* monitor_;
    Lengths lengths_;
    std::vector<Vec3> own_points_;  // where the object has no such array
    std::span<const Vec3> points_;
};

/// Whether an object is judged so, and holds anything that one of these checks looks at. A well without a path does not.
bool is_judged_alone(const Object& object);

/// M09 where points of the object have a coordinate that is not finite, or as large as 1e20: it is judged no further.
std::vector<Finding> huge_coordinates(const ObjectScope& scope);

/// A finding of the catalogue's severity about the object.
Finding object_finding(const ObjectScope& scope, std::string_view code, std::string message);
/// Lists some of its points (at most 100 of them) by the file's own numbers, marks and counts them.
void list_points(const ObjectScope& scope, std::span<const std::uint32_t> points, Finding& finding);
/// " of 'name'", or nothing where it has none.
std::string of_object(const ObjectScope& scope);

}  // namespace geomend::validators
