// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/vec3.h"

namespace geomend {

/// The box along the axes around points. Empty at first: its low ends lie above its high ones.
struct Bounds {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void add(const Vec3& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    void add(const Bounds& other) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], other.low[k]);
            high[k] = std::max(high[k], other.high[k]);
        }
    }
    bool empty() const { return low[0] > high[0]; }
};

/// Of a list of points. Cost: linear.
template <class Points>
Bounds bounds_around(const Points& points) {
    Bounds bounds;
    for (const Vec3& p : points) bounds.add(p);
    return bounds;
}

}  // namespace geomend
