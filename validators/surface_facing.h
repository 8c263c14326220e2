// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>

#include "validators/model_scope.h"

namespace geomend::validators {

/// Twice the area of a surface as a vector along its mean normal, and without regard to direction.
struct Facing {
    Vec3 normal{};
    double area = 0;
};

/// Linear in its triangles.
Facing facing_of(const ModelScope& scope, std::uint32_t surface);

/// Whether a surface has a clear upper side. One that has not is neither roof nor floor of what lies beside it.
inline bool looks_up_or_down(const Facing& facing) {
    constexpr double clearly = 0.3;  // of the area
    return facing.area > 0 && std::abs(facing.normal[2]) >= clearly * facing.area;
}

}  // namespace geomend::validators
