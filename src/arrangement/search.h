// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "arrangement/near_features.h"
#include "base/monitor.h"

namespace geomend::arrangement {

/// What all pairs of triangles have in common within a distance, but for what they share by number.
/// \param is_new per triangle; pairs of which neither is new are passed over: they were looked at before
/// \param points on the grid; \pre no triangle names a vertex twice
/// \param most_points where more new ones are found than that, the search ends, with some of them
/// In an order that does not depend on the number of threads; the same new point may come several times. Near-linear.
NearFeatures search(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const std::uint8_t> is_new,
                    double distance, const Monitor* monitor, std::size_t most_points = std::numeric_limits<std::size_t>::max());

}  // namespace geomend::arrangement
