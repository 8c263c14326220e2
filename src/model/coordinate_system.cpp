// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/coordinate_system.h"

namespace geomend {

bool axis_units_agree(const CoordinateSystem& crs) {
    return crs.axis_units[0] == crs.axis_units[1] && crs.axis_units[1] == crs.axis_units[2];
}

namespace {

bool is_default(const std::string& name) { return name.empty() || name == "Default" || name == "Unknown" || name == "gocad Local"; }

std::string difference(const char* what, const std::string& a, const std::string& b) {
    if (is_default(a) || is_default(b) || a == b) return {};
    return std::string(what) + " '" + a + "' and '" + b + "'";
}

}  // namespace

std::string disagreement(const CoordinateSystem& a, const CoordinateSystem& b, bool compare_sign) {
    if (auto d = difference("coordinate systems", a.name, b.name); !d.empty()) return d;
    if (auto d = difference("projections", a.projection, b.projection); !d.empty()) return d;
    if (auto d = difference("datums", a.datum, b.datum); !d.empty()) return d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (auto d = difference("axis units", a.axis_units[axis], b.axis_units[axis]); !d.empty()) return d;
    }
    if (compare_sign && a.z_positive != b.z_positive) return "depth-positive and elevation-positive Z";
    return {};
}

}  // namespace geomend
