// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"

namespace geomend::volumes {

/// The outward normals of a tetrahedron's faces, each opposite to its corner, of length 1. \pre its corners turn as orientation() +1
inline std::array<Vec3, 4> face_normals(const std::array<Vec3, 4>& p) {
    constexpr std::array<std::array<std::size_t, 3>, 4> face{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    std::array<Vec3, 4> normal{};
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 n = cross(minus(p[face[k][1]], p[face[k][0]]), minus(p[face[k][2]], p[face[k][0]]));
        const double size = std::sqrt(dot(n, n));
        normal[k] = size > 0 ? times(1 / size, n) : Vec3{};
    }
    return normal;
}

/// The cosines of the least and of the largest angle between two faces of a tetrahedron.
struct DihedralCosines {
    double of_least = -1, of_largest = 1;
};
inline DihedralCosines dihedral_cosines(const std::array<Vec3, 4>& p) {
    const std::array<Vec3, 4> normal = face_normals(p);
    DihedralCosines found;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t m = k + 1; m < 4; ++m) {
            const double cosine = -dot(normal[k], normal[m]);
            found.of_least = std::max(found.of_least, cosine);
            found.of_largest = std::min(found.of_largest, cosine);
        }
    }
    return found;
}

/// The least sine of the angles between two faces: 0 for a flat tetrahedron, 0.94 for the regular one; small angles and those near
/// 180 degrees count alike. That of an angle is 6 volumes by the edge between its faces by the lengths of their normals as cross products.
inline double least_sine(const std::array<Vec3, 4>& p) {
    const Vec3 a = minus(p[1], p[0]), b = minus(p[2], p[0]), c = minus(p[3], p[0]);
    const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b), abc = plus(plus(bc, ca), ab);
    const Vec3 ba = minus(b, a), cb = minus(c, b), ac = minus(a, c);
    const double six = dot(a, bc);
    if (six == 0) return 0;
    const double of_a = six / dot(bc, bc), of_b = six / dot(ca, ca), of_c = six / dot(ab, ab), of_0 = six / dot(abc, abc);
    const double squares = std::min({dot(a, a) * of_b * of_c, dot(b, b) * of_c * of_a, dot(c, c) * of_a * of_b, dot(ba, ba) * of_c * of_0,
                                     dot(cb, cb) * of_a * of_0, dot(ac, ac) * of_b * of_0});
    return squares > 0 ? std::min(1.0, std::sqrt(squares)) : 0;
}

/// Radius of the inscribed sphere by that of the circumscribed one, times 3: 1 for the regular tetrahedron, 0 for a flat one.
inline double shape(const std::array<Vec3, 4>& p) {
    const Vec3 a = minus(p[1], p[0]), b = minus(p[2], p[0]), c = minus(p[3], p[0]);
    const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double six = dot(a, bc);
    const auto size = [](const Vec3& v) { return std::sqrt(dot(v, v)); };
    const double areas = size(bc) + size(ca) + size(ab) + size(plus(plus(bc, ca), ab));                // twice the areas
    const Vec3 centre = plus(plus(times(dot(a, a), bc), times(dot(b, b), ca)), times(dot(c, c), ab));  // twice the volume by 6 times it
    const double round = size(centre);
    return areas > 0 && round > 0 ? std::abs(3 * (six / areas) * (2 * six / round)) : 0;
}

}  // namespace geomend::volumes
