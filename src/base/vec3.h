// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>

namespace geomend {

/// A position or a direction: x, y, z. Laid out as three consecutive doubles.
using Vec3 = std::array<double, 3>;

}  // namespace geomend
