// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/vec3.h"

namespace geomend::grid {

/// The side that a cell turns to a neighbouring column: it lies between two pillars a and b, and its upper and lower
/// edges run straight from depths on a to depths on b.
struct Side {
    double top_a, top_b, bottom_a, bottom_b;
    bool operator==(const Side&) const = default;
    /// False where the side has no area or is folded on either pillar.
    bool upright() const { return bottom_a >= top_a && bottom_b >= top_b; }
};

/// A corner of the part that two sides share. At fraction u from pillar a to b; `first` and `second` are the edges
/// (depth on a, depth on b) that cross there, equal where the corner is one of a pillar: u is then 0 or 1.
struct OverlapCorner {
    double u = 0;
    std::array<double, 2> first{}, second{};
};

/// Convex polygon, upper edge from a to b first, then back along the lower one; 3 to 6 corners.
struct Overlap {
    std::array<OverlapCorner, 6> corners;
    std::uint32_t count = 0;
    std::span<const OverlapCorner> polygon() const { return {corners.data(), count}; }
};

/// True where two sides on the same pair of pillars share area. Edges that only touch share none. Exact for shares
/// that reach a pillar.
bool overlaps(const Side& a, const Side& b);

/// The share of two sides; count 0 where it has no area. Signs are decided by comparing depths, so that sides which
/// agree to the bit share them wholly.
Overlap overlap(const Side& a, const Side& b);

/// Position of a corner: where its edges cross, both pillars are taken at the depth of the crossing, as simulators do.
/// \param at(pillar 0|1, depth) gives the point of a pillar
template <class At>
Vec3 position(const OverlapCorner& corner, const At& at) {
    if (corner.u == 0) return at(0, corner.first[0]);
    if (corner.u == 1) return at(1, corner.first[1]);
    const double depth = corner.first[0] + corner.u * (corner.first[1] - corner.first[0]);
    const Vec3 p = at(0, depth), q = at(1, depth);
    return {p[0] + corner.u * (q[0] - p[0]), p[1] + corner.u * (q[1] - p[1]), depth};
}

}  // namespace geomend::grid
