// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
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

/// The place whose least depth is the greatest, and the half spaces that keep it from being deeper: those are in the way where the depth
/// is not positive. Which of `all`: no_index for the sides of the tetrahedron looked in.
struct DeepestPlace {
    Vec3 place;
    double depth;
    std::array<std::uint32_t, 4> tight;
};

/// Looks in a regular tetrahedron around a place. Nothing where rounding leaves it undecided. The dual simplex method in four unknowns.
/// \param reach of the sides of the tetrahedron from its middle; it should be far larger than what the half spaces have in common
/// Cost: some microseconds for ten half spaces, about linear.
std::optional<DeepestPlace> deepest_place(std::span<const HalfSpace> all, const Vec3& middle, double reach);

}  // namespace geomend::hexes
