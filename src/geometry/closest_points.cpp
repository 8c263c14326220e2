// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/closest_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/predicates.h"
#include "geometry/vectors.h"

namespace geomend {

namespace {

using Segment = std::array<Vec3, 2>;
using Corners = std::array<Vec3, 3>;

/// A pair of points, the parts that they lie on (bits of corners), and the square of their distance.
struct Squared {
    double square = HUGE_VAL;
    Vec3 first{}, second{};
    unsigned first_part = 0, second_part = 0;

    void take_if_closer(const Squared& other) {
        if (other.square < square) *this = other;
    }
    Squared turned() const { return {square, second, first, second_part, first_part}; }
};

double square_of(const Vec3& d) { return dot(d, d); }

Vec3 at(const Vec3& p, const Vec3& q, double t) { return plus(p, times(t, minus(q, p))); }

/// Names of the corners of an edge: bits.
struct Names {
    unsigned p, q;
};
Names names_of_edge(std::size_t i) { return {1u << i, 1u << (i + 1) % 3}; }
constexpr Names names_of_segment{1, 2};

Squared nearest(const Vec3& point, unsigned name, const Segment& s, Names names) {
    const Vec3 d = minus(s[1], s[0]);
    const double along = dot(minus(point, s[0]), d), whole = dot(d, d);
    if (along <= 0 || whole == 0) return {square_of(minus(point, s[0])), point, s[0], name, names.p};
    if (along >= whole) return {square_of(minus(point, s[1])), point, s[1], name, names.q};
    const Vec3 foot = at(s[0], s[1], along / whole);
    return {square_of(minus(point, foot)), point, foot, name, names.p | names.q};
}

/// Either the inner points where the common perpendicular stands, or an end of one and the nearest point of the other.
Squared nearest(const Segment& a, Names a_names, const Segment& b, Names b_names) {
    Squared best = nearest(a[0], a_names.p, b, b_names);
    best.take_if_closer(nearest(a[1], a_names.q, b, b_names));
    best.take_if_closer(nearest(b[0], b_names.p, a, a_names).turned());
    best.take_if_closer(nearest(b[1], b_names.q, a, a_names).turned());
    const Vec3 u = minus(a[1], a[0]), v = minus(b[1], b[0]), w = minus(b[0], a[0]);
    const Vec3 n = cross(u, v);
    const double square = dot(n, n);
    if (square > 0) {
        const double s = dot(cross(w, v), n) / square, t = dot(cross(w, u), n) / square;
        if (s > 0 && s < 1 && t > 0 && t < 1) {
            const Vec3 p = at(a[0], a[1], s), q = at(b[0], b[1], t);
            best.take_if_closer({square_of(minus(p, q)), p, q, a_names.p | a_names.q, b_names.p | b_names.q});
        }
    }
    return best;
}

/// The foot of the perpendicular where it falls into the triangle, else a point of an edge.
Squared nearest(const Vec3& point, unsigned name, const Corners& t) {
    const Vec3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double square = dot(n, n);
    bool inside = square > 0;
    for (std::size_t i = 0; inside && i < 3; ++i) inside = dot(n, cross(minus(t[(i + 1) % 3], t[i]), minus(point, t[i]))) > 0;
    if (inside) {
        const Vec3 up = times(dot(n, minus(point, t[0])) / square, n);
        return {square_of(up), point, minus(point, up), name, 7};
    }
    Squared best;
    for (std::size_t i = 0; i < 3; ++i) best.take_if_closer(nearest(point, name, {t[i], t[(i + 1) % 3]}, names_of_edge(i)));
    return best;
}

/// A point found, at its place in the coordinates that were given.
template <std::size_t n>
Vec3 back_from(const Vec3& origin, const Vec3& point, unsigned part, const std::array<Vec3, n>& corners) {
    for (std::size_t i = 0; i < n; ++i) {
        if (part == 1u << i) return corners[i];
    }
    return plus(origin, point);
}

template <std::size_t n, std::size_t m>
Closest back_from(const Vec3& origin, const Squared& found, const std::array<Vec3, n>& first, const std::array<Vec3, m>& second) {
    return {std::sqrt(found.square),
            back_from(origin, found.first, found.first_part, first),
            back_from(origin, found.second, found.second_part, second),
            minus(found.second, found.first),
            found.first_part,
            found.second_part};
}

template <std::size_t n>
std::array<Vec3, n> relative_to(const Vec3& origin, const std::array<Vec3, n>& points) {
    std::array<Vec3, n> moved;
    for (std::size_t i = 0; i < n; ++i) moved[i] = minus(points[i], origin);
    return moved;
}

/// Where the line of the segment passes through the plane of the triangle, it does so inside or on an edge.
bool passes_inside(const Segment& s, const Corners& t) {
    int low = 1, high = -1;
    for (std::size_t i = 0; i < 3; ++i) {
        const int side = orientation(s[0], s[1], t[i], t[(i + 1) % 3]);
        low = std::min(low, side);
        high = std::max(high, side);
    }
    return low >= 0 || high <= 0;
}

bool inside_2d(const Vec3& p, const Corners& t, unsigned axis) {
    int low = 1, high = -1;
    for (std::size_t i = 0; i < 3; ++i) {
        const int side = orientation_2d(t[i], t[(i + 1) % 3], p, axis);
        low = std::min(low, side);
        high = std::max(high, side);
    }
    return low >= 0 || high <= 0;
}

bool cross_2d(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, unsigned axis) {
    return orientation_2d(p, q, r, axis) * orientation_2d(p, q, s, axis) < 0 &&
           orientation_2d(r, s, p, axis) * orientation_2d(r, s, q, axis) < 0;
}

bool meets_in_plane(const Segment& s, const Corners& t) {
    unsigned axis = 0;
    while (axis < 2 && orientation_2d(t[0], t[1], t[2], axis) == 0) ++axis;
    if (inside_2d(s[0], t, axis) || inside_2d(s[1], t, axis)) return true;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &p = t[i], &q = t[(i + 1) % 3];
        if (cross_2d(s[0], s[1], p, q, axis)) return true;
        // Neither end is inside: what is left is a segment that enters through a corner.
        const bool on_line = orientation_2d(s[0], s[1], p, axis) == 0;
        const bool between = std::min(s[0], s[1]) <= p && p <= std::max(s[0], s[1]);
        if (on_line && between) return true;
    }
    return false;
}

}  // namespace

bool meets(const Segment& segment, const Corners& triangle) {
    const int first = orientation(triangle[0], triangle[1], triangle[2], segment[0]);
    const int second = orientation(triangle[0], triangle[1], triangle[2], segment[1]);
    if (first * second > 0) return false;
    if (first == 0 && second == 0) return meets_in_plane(segment, triangle);
    return passes_inside(segment, triangle);
}

Closest closest_points(const Vec3& point, const Corners& triangle) {
    const Vec3& origin = triangle[0];
    const Squared best = nearest(minus(point, origin), 1, relative_to(origin, triangle));
    return back_from(origin, best, std::array<Vec3, 1>{point}, triangle);
}

Closest closest_points(const Segment& segment, const Corners& triangle) {
    const Vec3& origin = triangle[0];
    const Segment s = relative_to(origin, segment);
    const Corners t = relative_to(origin, triangle);
    Squared best = nearest(s[0], 1, t);
    best.take_if_closer(nearest(s[1], 2, t));
    for (std::size_t i = 0; i < 3; ++i) best.take_if_closer(nearest(s, names_of_segment, {t[i], t[(i + 1) % 3]}, names_of_edge(i)));
    Closest found = back_from(origin, best, segment, triangle);
    if (!in_line(triangle[0], triangle[1], triangle[2]) && meets(segment, triangle)) found.distance = 0;
    return found;
}

Closest closest_points(const Corners& first, const Corners& second) {
    const Vec3& origin = first[0];
    const Corners a = relative_to(origin, first), b = relative_to(origin, second);
    Squared best;
    for (std::size_t i = 0; i < 3; ++i) {
        best.take_if_closer(nearest(a[i], 1u << i, b));
        best.take_if_closer(nearest(b[i], 1u << i, a).turned());
        for (std::size_t j = 0; j < 3; ++j) {
            best.take_if_closer(nearest({a[i], a[(i + 1) % 3]}, names_of_edge(i), {b[j], b[(j + 1) % 3]}, names_of_edge(j)));
        }
    }
    return back_from(origin, best, first, second);
}

}  // namespace geomend
