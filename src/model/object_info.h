// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "model/attribute.h"
#include "model/coordinate_system.h"
#include "model/feature.h"

namespace geomend {

/// File's own ids of points or cells. When `ids` is empty they run first, first+1, ... in array order.
struct Labels {
    std::int64_t first = 1;
    std::vector<std::int64_t> ids;

    std::int64_t operator[](std::size_t i) const { return ids.empty() ? first + static_cast<std::int64_t>(i) : ids[i]; }
};

/// A named set of points or cells of an object (Gocad REGION bits, MSH or VTK groups). Indices ascend.
struct NamedSet {
    std::string name;
    AttributeLocation location = AttributeLocation::point;
    std::vector<std::uint32_t> members;
};

/// Text that a format says of an object and that is kept for the way back. Keys begin with the family:
/// "gocad.header" values are whole "key:value" lines, "gocad.record" whole unknown records, "vtk.field" ...
struct Annotation {
    std::string key;
    std::string value;
};

/// A group that a file states; objects name it in ObjectInfo::groups.
struct StatedGroup {
    std::vector<std::string> path;  ///< its name after those of the groups that hold it, outermost first
    std::string head;               ///< what the file says of the group itself, verbatim
};

/// The precision in which a file stores coordinates.
enum class CoordinatePrecision : std::uint8_t { double_precision, single_precision };

/// What every object has whatever its geometry.
struct ObjectInfo {
    std::string name;
    FeatureRole role = FeatureRole::unknown;
    std::string role_text;  ///< the file's own word ("normal_fault"); empty: not stated
    std::string feature;    ///< geological feature that the object is a part of; empty: not stated
    CoordinateSystem crs;
    /// How the file that the object was read from stores its coordinates. Text counts as double precision. Coordinates that are
    /// computed anew are double precision.
    CoordinatePrecision precision = CoordinatePrecision::double_precision;
    Vec3 stored_around{0, 0, 0};  ///< offset that was added to what the file stores, in the object's own axes
    std::vector<Attribute> attributes;
    std::vector<NamedSet> sets;
    std::vector<Annotation> annotations;  ///< in file order
    std::vector<std::string> groups;      ///< names of the groups that hold it, outermost first
};

}  // namespace geomend
