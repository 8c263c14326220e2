// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>

#include "base/vec3.h"

namespace geomend {

/// Eigenvectors of a symmetric matrix xx xy xz yy yz zz, by ascending eigenvalue (Jacobi).
std::array<Vec3, 3> principal_axes(const std::array<double, 6>& moments);

}  // namespace geomend
