// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/vectors.h"

namespace geomend::test {

/// The points x with normal . x = level; `side` +1 keeps what is above it, -1 what is below.
struct Plane {
    Vec3 normal;
    double level;
    double height(const Vec3& p) const { return dot(normal, p) - level; }
};

using Outline = std::vector<Vec3>;  ///< a planar convex polygon

/// The part of a polygon on one side of a plane moved outwards by `more` (a distance).
inline Outline clipped(const Outline& outline, const Plane& plane, double side, double more = 0) {
    Outline kept;
    const double shift = more * std::sqrt(dot(plane.normal, plane.normal));
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        const double at_a = side * plane.height(a) + shift, at_b = side * plane.height(b) + shift;
        if (at_a >= 0) kept.push_back(a);
        if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) kept.push_back(plus(a, times(at_a / (at_a - at_b), minus(b, a))));
    }
    return kept;
}

/// A convex solid as its faces, each counter-clockwise from outside.
struct ConvexCell {
    std::vector<Outline> faces;

    bool empty() const { return faces.size() < 4; }
    double volume() const {
        double sum = 0;
        for (const Outline& face : faces) {
            for (std::size_t i = 2; i < face.size(); ++i)
                sum += dot(minus(face[0], faces[0][0]), cross(minus(face[i - 1], face[0]), minus(face[i], face[0])));
        }
        return sum / 6;
    }
};

inline ConvexCell box_cell(const Vec3& low, const Vec3& high) {
    const auto corner = [&](int i) { return Vec3{(i & 1) ? high[0] : low[0], (i & 2) ? high[1] : low[1], (i & 4) ? high[2] : low[2]}; };
    ConvexCell cell;
    for (const auto& f :
         std::vector<std::vector<int>>{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
        Outline face;
        for (const int i : f) face.push_back(corner(i));
        cell.faces.push_back(face);
    }
    return cell;
}

/// The part of a solid on one side of a plane.
inline ConvexCell clipped(const ConvexCell& cell, const Plane& plane, double side) {
    ConvexCell kept;
    Outline rim;
    for (const Outline& face : cell.faces) {
        Outline part = clipped(face, plane, side);
        if (part.size() < 3) continue;
        for (const Vec3& p : part) {
            if (std::abs(plane.height(p)) <= 1e-9 * (1 + std::abs(plane.level))) rim.push_back(p);
        }
        kept.faces.push_back(std::move(part));
    }
    if (kept.faces.size() == cell.faces.size() && rim.empty()) return kept;
    Vec3 middle{};
    for (const Vec3& p : rim) middle = plus(middle, times(1.0 / static_cast<double>(rim.size()), p));
    const Vec3 outward = times(-side, plane.normal);
    const Vec3 u = rim.empty() ? Vec3{1, 0, 0} : minus(rim[0], middle), v = cross(outward, u);
    std::sort(rim.begin(), rim.end(), [&](const Vec3& a, const Vec3& b) {
        return std::atan2(dot(minus(a, middle), v) / std::sqrt(dot(v, v)), dot(minus(a, middle), u) / std::sqrt(dot(u, u))) <
               std::atan2(dot(minus(b, middle), v) / std::sqrt(dot(v, v)), dot(minus(b, middle), u) / std::sqrt(dot(u, u)));
    });
    if (rim.size() >= 3) kept.faces.push_back(rim);
    return kept;
}

}  // namespace geomend::test
