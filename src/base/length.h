// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>

#include "base/vectors.h"

namespace geomend {

inline double length(const Vec3& d) { return std::sqrt(dot(d, d)); }

}  // namespace geomend
