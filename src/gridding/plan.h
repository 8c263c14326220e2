// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace geomend::gridding {

/// A point in plan.
using Point = std::array<double, 2>;
/// A line in plan, through its points in order. A ring is a path whose last point leads back to the first one.
using Path = std::vector<Point>;

inline double distance(const Point& a, const Point& b) {
    const double x = b[0] - a[0], y = b[1] - a[1];
    return __builtin_sqrt(x * x + y * y);
}

/// The length of a path. Cost: linear, as of all functions here.
double length(std::span<const Point> path);

/// The place of a path that is nearest to a point.
struct OnPath {
    double distance = std::numeric_limits<double>::infinity();
    double along = 0;  ///< length of the path from its first point to there
    Point at{};
    std::size_t segment = 0;  ///< from point `segment` to the next one
    double left = 0;          ///< how far the point lies to the left of that segment's direction; negative: to its right
    bool before_first = false, after_last = false;  ///< it is an end of the path, and the point lies beyond it
};

/// \pre the path has a point
OnPath nearest_on(std::span<const Point> path, const Point& p);

/// Whether a point lies within a ring; on its line either may come out.
bool is_inside(std::span<const Point> ring, const Point& p);

/// The area within a ring, positive where it turns to the left.
double area_of(std::span<const Point> ring);

/// The point of a path at a length from its first point; an end where that is beyond it.
Point point_at(std::span<const Point> path, double along);

/// The part of a path between two lengths from its first point. \pre 0 <= from <= to
Path part_of(std::span<const Point> path, double from, double to);

/// The longest part of a path that lies within a ring; empty where none does.
Path longest_inside(std::span<const Point> path, std::span<const Point> ring);

/// The convex hull, turning left, without points in line. Cost: n log n.
Path convex_hull(std::vector<Point> points);

}  // namespace geomend::gridding
