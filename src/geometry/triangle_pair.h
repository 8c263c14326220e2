// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/vec3.h"
#include "geometry/contact.h"

namespace geomend {

struct TriangleMeeting {
    Meeting kind = Meeting::none;
    /// The common segment, rounded: ends at vertices are exact; where an edge pierces a triangle the end is the
    /// same to the bit for all triangles at that edge. A point has two equal ends. An overlap gives its longest extent.
    std::array<Vec3, 2> segment{};
};

/// How two triangles meet, decided exactly (range of coordinates: see predicates.h).
/// \param a, b vertex numbers in any order; vertices are shared where numbers are equal, and not where only positions are
/// \pre neither triangle is degenerate: three different numbers, positions not in line
/// Cost: 50 to 300 ns, some microseconds where rounding would decide.
TriangleMeeting meeting(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b);

}  // namespace geomend
