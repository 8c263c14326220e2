// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>

#include "base/length.h"
#include "geometry/vectors.h"

namespace geomend::arrangement {

/// The nearest point of the grid.
inline Vec3 rounded(const Vec3& p) { return {std::nearbyint(p[0]), std::nearbyint(p[1]), std::nearbyint(p[2])}; }

/// Whether a point lies within the distance of a segment, beyond neither end.
inline bool is_near_segment(const Vec3& x, const Vec3& p, const Vec3& q, double distance) {
    const Vec3 d = minus(q, p), w = minus(x, p);
    const double along = dot(w, d), square = dot(d, d);
    if (along <= 0 || along >= square) return false;
    const Vec3 off = minus(w, times(along / square, d));
    return dot(off, off) <= distance * distance;
}

/// Whether two segments pass within the distance of each other, inside both; then `middle` is the point of the grid half-way
/// between. Segments that are next to parallel do not: their ends tell.
inline bool pass_near(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, double distance, Vec3& middle) {
    const Vec3 u = minus(q, p), v = minus(s, r), w = minus(p, r);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double square = uu * vv - uv * uv;
    if (square <= 1e-14 * uu * vv) return false;
    const double a = (uv * vw - vv * uw) / square, b = (uu * vw - uv * uw) / square;
    if (a <= 0 || a >= 1 || b <= 0 || b >= 1) return false;
    const Vec3 x = plus(p, times(a, u)), y = plus(r, times(b, v)), gap = minus(x, y);
    if (dot(gap, gap) > distance * distance) return false;
    middle = rounded(times(0.5, plus(x, y)));
    return true;
}

}  // namespace geomend::arrangement
