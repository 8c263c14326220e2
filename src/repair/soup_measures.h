// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "base/vectors.h"
#include "model/triangle_soup.h"

namespace geomend::repair {

/// The normal of a triangle, as it is wound; its length is twice the area.
inline Vec3 triangle_normal(const TriangleSoup& soup, std::uint32_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    return cross(minus(soup.vertices[b], soup.vertices[a]), minus(soup.vertices[c], soup.vertices[a]));
}

inline double triangle_area(const TriangleSoup& soup, std::uint32_t t) {
    const Vec3 n = triangle_normal(soup, t);
    return 0.5 * std::sqrt(dot(n, n));
}

}  // namespace geomend::repair
