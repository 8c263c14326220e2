// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/vectors.h"

namespace geomend::hexes {

/// The points x with dot(normal, x) >= offset; the normal has length 1.
struct HalfSpace {
    Vec3 normal;
    double offset;
    double depth(const Vec3& x) const { return dot(normal, x) - offset; }
};

/// Adds the half space in front of a triangle, where it has an area.
void add_half_space(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<HalfSpace>& all);

/// The place deepest inside of all half spaces, or nothing where they have no inside in common, are open, or are more than 28: four of
/// them are equally near there. Cost: the fourth power of their number; 1 millisecond for 28.
std::optional<Vec3> deepest_place(std::span<const HalfSpace> all);

}  // namespace geomend::hexes
