// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "base/vec3.h"
#include "hexes/half_spaces.h"

namespace geomend::hexes {

/// A quadrangle and the fan of tetrahedra behind it: they lie around the diagonal from its first to its third corner, and have their other
/// two corners on a chain from its second corner to its fourth.
struct Fan {
    std::array<Vec3, 4> quad;     ///< its normal points into the fan
    std::span<const Vec3> chain;  ///< second corner, ..., fourth corner
    /// Where a vertex leaves room for what else has to be put there; it is to be in them as well.
    std::span<const HalfSpace> also = {};
};

/// A place for a vertex in a fan: the pyramid over the quadrangle and the tetrahedra that it makes with the fan's outer facets have their
/// worst shape as good as was found.
struct ApexPlace {
    Vec3 position{};
    double quality = 0;  ///< the least scaled_jacobian() of these cells; not positive: there is no such place
};
ApexPlace place_for_apex(const Fan& fan);

/// Whether there is any place. Cost: 1 microsecond where it is easy to find, some 50 where there is none.
bool has_place_for_apex(const Fan& fan);

}  // namespace geomend::hexes
