// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>

#include "base/vec3.h"

namespace geomend::validators {

/// The area that two triangles have in common, the first one seen at right angles onto the plane of the second: 0 where they are
/// side by side. Constant time. \pre the second one is not degenerate
double common_area(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

/// True where two triangles lie on each other: each corner of one of them is within the tolerance of the plane of the other, and
/// their common area is more than a strip as wide as the tolerance. Degenerate triangles lie on nothing.
bool lie_on_each_other(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double tolerance);

/// How long the part of a segment is that lies within the tolerance of a triangle's plane and, seen at right angles to it, inside
/// the triangle. 0 for degenerate triangles.
double length_on(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle, double tolerance);

}  // namespace geomend::validators
