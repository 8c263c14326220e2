// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::wells {

/// The length of a path from its first point to each point, from 0.
inline std::vector<double> lengths_along(std::span<const Vec3> path) {
    std::vector<double> lengths;
    lengths.reserve(path.size());
    double length = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (i > 0) length += std::hypot(path[i][0] - path[i - 1][0], path[i][1] - path[i - 1][1], path[i][2] - path[i - 1][2]);
        lengths.push_back(length);
    }
    return lengths;
}

}  // namespace geomend::wells
