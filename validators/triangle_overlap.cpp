// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/triangle_overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/vectors.h"

namespace geomend::validators {

namespace {

double longest_side(const std::array<Vec3, 3>& t) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 e = minus(t[(i + 1) % 3], t[i]);
        longest = std::max(longest, dot(e, e));
    }
    return std::sqrt(longest);
}

/// The largest distance of a corner of a triangle from the plane of another one; infinite where that has none.
double farthest_from_plane(const std::array<Vec3, 3>& t, const std::array<Vec3, 3>& plane) {
    const Vec3 n = cross(minus(plane[1], plane[0]), minus(plane[2], plane[0]));
    const double length = std::sqrt(dot(n, n));
    if (length == 0) return HUGE_VAL;
    double farthest = 0;
    for (const Vec3& corner : t) farthest = std::max(farthest, std::abs(dot(minus(corner, plane[0]), n)) / length);
    return farthest;
}

}  // namespace

double common_area(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    const Vec3 n = cross(minus(b[1], b[0]), minus(b[2], b[0]));
    std::vector<Vec3> polygon(a.begin(), a.end()), kept;
    for (std::size_t i = 0; i < 3; ++i) {  // cut away what lies beyond each side of b
        const Vec3 inwards = cross(n, minus(b[(i + 1) % 3], b[i]));
        kept.clear();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec3 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
            const double here = dot(minus(from, b[i]), inwards), there = dot(minus(to, b[i]), inwards);
            if (here >= 0) kept.push_back(from);
            if ((here > 0 && there < 0) || (here < 0 && there > 0))
                kept.push_back(plus(from, times(here / (here - there), minus(to, from))));
        }
        polygon.swap(kept);
    }
    double twice = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        twice += dot(cross(minus(polygon[k - 1], polygon[0]), minus(polygon[k], polygon[0])), n);
    return 0.5 * std::abs(twice) / std::sqrt(dot(n, n));
}

bool lie_on_each_other(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double tolerance) {
    const double ab = farthest_from_plane(a, b), ba = farthest_from_plane(b, a);
    if (std::min(ab, ba) > tolerance) return false;
    const double area = ba == HUGE_VAL || ab == HUGE_VAL ? 0 : common_area(a, b);
    return area > 2 * tolerance * std::min(longest_side(a), longest_side(b));
}

double length_on(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle, double tolerance) {
    const Vec3 n = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
    const double length = std::sqrt(dot(n, n));
    if (length == 0) return 0;
    double from = 0, to = 1;                            // of the segment
    const auto keep = [&](double here, double there) {  // where a linear function is not negative
        if (here < 0 && there < 0) to = -1;
        else if (here < 0) from = std::max(from, here / (here - there));
        else if (there < 0) to = std::min(to, here / (here - there));
    };
    const double above = dot(minus(segment[0], triangle[0]), n) / length, then = dot(minus(segment[1], triangle[0]), n) / length;
    keep(tolerance - above, tolerance - then);
    keep(tolerance + above, tolerance + then);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 side = minus(triangle[(i + 1) % 3], triangle[i]), inwards = cross(n, side);
        const double slack = tolerance * std::sqrt(dot(inwards, inwards));
        keep(dot(minus(segment[0], triangle[i]), inwards) + slack, dot(minus(segment[1], triangle[i]), inwards) + slack);
    }
    const Vec3 way = minus(segment[1], segment[0]);
    return to > from ? (to - from) * std::sqrt(dot(way, way)) : 0;
}

}  // namespace geomend::validators
