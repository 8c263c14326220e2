// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "remesh/vertex_sizes.h"

namespace geomend::remeshing {

/// A place on a polyline: at a share of the way from point `segment` to the next one. Share 0: the point itself, to the bit.
struct LineSample {
    std::uint32_t segment = 0;
    double share = 0;
    bool operator==(const LineSample&) const = default;
};

struct LineRules {
    double max_distance = 0;              ///< no point of the polyline is farther from the new one
    std::uint32_t fewest = 1;             ///< segments of the new one
    double sharp_bend = 0.7;              ///< radians: a bend above this, as seen over half the size, stays where it is
    std::span<const std::uint8_t> stays;  ///< per point 1 where it is kept; empty: none but the ends
};

/// New places on a polyline from its first to its last point: pieces between points that stay are parted evenly, as measured by the
/// sizes along them, and more finely where the way bends too much for the distance.
/// \param sizes per point, above 0  \pre at least 2 points. Cost: linear for each try, few tries.
std::vector<LineSample> sample_line(std::span<const Vec3> points, const VertexSizes& sizes, const LineRules& rules);

Vec3 place_of(std::span<const Vec3> points, const LineSample& sample);

/// Lowers the size at each point to that of the new segments beside it, where that is less. \param least no size becomes less
void limit_sizes(std::span<const Vec3> points, std::span<const LineSample> samples, double least, std::span<double> sizes);

}  // namespace geomend::remeshing
