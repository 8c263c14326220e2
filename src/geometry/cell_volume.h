// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/vectors.h"

namespace geomend {

/// Six times the volume between a triangle and the origin, positive when the triangle's normal points away from it.
inline double flux6(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }
/// The same for the bilinear patch over a quadrangle: exactly the mean of its two splits into triangles.
inline double flux6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return 0.5 * (flux6(a, b, c) + flux6(a, c, d) + flux6(a, b, d) + flux6(b, c, d));
}

/// Signed volume of a tetrahedron, positive when (p1-p0, p2-p0, p3-p0) is right-handed: its sign is exact.
double tetrahedron_volume(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3);
/// Signed volume of a trilinear hexahedron in VTK's corner order. Exact (but for rounding): the determinant of
/// the map integrates to the flux through its six bilinear faces.
double hexahedron_volume(const std::array<Vec3, 8>& corners);
/// Signed volume of a pyramid over a bilinear base (corners 0..3), apex 4; positive when the base's normal points to
/// the apex.
double pyramid_volume(const std::array<Vec3, 5>& corners);
/// Signed volume of a prism over an n-gon, corners 0..n-1 and n..2n-1; positive when the normal of the first n points to
/// the others. Bilinear sides; the ends are split into the fan of their corner with the lowest id.
/// \pre corners.size() == ids.size() == 2n, n >= 3
double prism_volume(std::span<const Vec3> corners, std::span<const std::uint32_t> ids);

}  // namespace geomend
