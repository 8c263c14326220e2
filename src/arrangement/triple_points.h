// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/near_features.h"

namespace geomend::arrangement {

/// A segment inside of a triangle, and the other triangle that meets it in one line there; no_index where they lie on each other.
struct SegmentInFace {
    std::uint32_t triangle;
    Link segment;
    std::uint32_t other;
    auto operator<=>(const SegmentInFace&) const = default;
};

/// Three triangles meet in one point. Each of them has two segments that cross there, and finds the point for itself; where the
/// triangles are next to parallel, rounding puts the three places far from each other, and the lens between them would be cut
/// again and again. So all take the place at which two segments cross most steeply: what the others' segments bend by lies in all three
/// planes. After N. Euler's sets of triangles (thesis, 3.3). \param segments ascending \param triangles per crossing the one inside of
/// which it is. Cost: n log n in crossings.
void join_triple_points(std::span<const Vec3> points, std::span<const SegmentInFace> segments, std::span<const std::uint32_t> triangles,
                        std::span<NewPoint> crossings);

}  // namespace geomend::arrangement
