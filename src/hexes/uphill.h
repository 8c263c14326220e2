// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "base/vec3.h"
#include "hexes/open_diagonal.h"

namespace geomend::hexes {

/// Goes uphill from a place of an apex by steps along the axes, halved where none leads on.
/// \param step the first one, a length \param try_place called with a place and the best so far, which it replaces where it is better
/// Cost: 144 calls.
template <class TryPlace>
void go_uphill(double step, ApexPlace& best, const TryPlace& try_place) {
    for (int round = 0; round < 24; ++round) {
        const ApexPlace before = best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                Vec3 p = before.position;
                p[axis] += sign * step;
                try_place(p, best);
            }
        }
        if (best.quality <= before.quality) step *= 0.5;
    }
}

}  // namespace geomend::hexes
