// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>

#include "base/vectors.h"

namespace geomend {

inline double length(const Vec3& d) { return std::sqrt(dot(d, d)); }

inline double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * length(cross(minus(b, a), minus(c, a))); }

}  // namespace geomend
