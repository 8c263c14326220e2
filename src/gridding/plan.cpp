// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/plan.h"

#include <algorithm>

namespace geomend::gridding {

namespace {

double turn(const Point& o, const Point& a, const Point& b) { return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]); }

Point between(const Point& a, const Point& b, double t) { return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}; }

/// Where a segment crosses the lines of a ring, as shares of it, ascending.
std::vector<double> crossings(const Point& a, const Point& b, std::span<const Point> ring) {
    std::vector<double> found;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point &c = ring[i], &d = ring[(i + 1) % ring.size()];
        const double ca = turn(c, d, a), cb = turn(c, d, b);
        const double ac = turn(a, b, c), ad = turn(a, b, d);
        if ((ca < 0) == (cb < 0) || (ac < 0) == (ad < 0)) continue;
        found.push_back(ca / (ca - cb));
    }
    std::ranges::sort(found);
    return found;
}

}  // namespace

double length(std::span<const Point> path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
    return sum;
}

OnPath nearest_on(std::span<const Point> path, const Point& p) {
    OnPath best;
    best.at = path[0];
    best.distance = distance(path[0], p);
    double before = 0, square = best.distance * best.distance;
    bool first = true;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const Point &a = path[i], &b = path[i + 1];
        const double x = b[0] - a[0], y = b[1] - a[1], size = x * x + y * y;
        if (size == 0) continue;
        const double share = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / size;
        const double t = std::clamp(share, 0.0, 1.0);
        const Point at = t == 1 ? b : between(a, b, t);
        const double dx = p[0] - at[0], dy = p[1] - at[1], d = dx * dx + dy * dy;
        const double l = __builtin_sqrt(size);
        if (first || d < square) {
            best = {__builtin_sqrt(d), before + t * l, at, i, (x * (p[1] - a[1]) - y * (p[0] - a[0])) / l, share < 0 && first, false};
            square = d;
            best.after_last = share > 1 && i + 2 == path.size();
        } else if (d == square && t == 0) {
            // A corner of the path: the side is that of the segment to which the point is more to the side.
            const double left = (x * (p[1] - a[1]) - y * (p[0] - a[0])) / l;
            if (__builtin_fabs(left) > __builtin_fabs(best.left)) best.left = left;
        }
        first = false;
        before += l;
    }
    return best;
}

bool is_inside(std::span<const Point> ring, const Point& p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Point &a = ring[i], &b = ring[j];
        if ((a[1] > p[1]) == (b[1] > p[1])) continue;
        if (p[0] < (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]) + a[0]) inside = !inside;
    }
    return inside;
}

double area_of(std::span<const Point> ring) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += turn(ring[0], ring[i], ring[i + 1]);
    return sum / 2;
}

Point point_at(std::span<const Point> path, double along) {
    for (std::size_t i = 1; i < path.size(); ++i) {
        const double l = distance(path[i - 1], path[i]);
        if (along <= l && l > 0) return between(path[i - 1], path[i], std::max(along, 0.0) / l);
        along -= l;
    }
    return path.back();
}

Path part_of(std::span<const Point> path, double from, double to) {
    Path part{point_at(path, from)};
    double at = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        at += distance(path[i - 1], path[i]);
        if (at > from && at < to) part.push_back(path[i]);
    }
    part.push_back(point_at(path, to));
    return part;
}

Path longest_inside(std::span<const Point> path, std::span<const Point> ring) {
    // The lengths at which the path comes in or goes out.
    std::vector<double> marks{0};
    double at = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const double l = distance(path[i - 1], path[i]);
        for (const double t : crossings(path[i - 1], path[i], ring)) marks.push_back(at + t * l);
        at += l;
    }
    marks.push_back(at);
    double from = 0, to = -1, begin = 0;
    bool within = false;
    for (std::size_t i = 1; i < marks.size(); ++i) {
        const bool inside = marks[i] > marks[i - 1] && is_inside(ring, point_at(path, (marks[i - 1] + marks[i]) / 2));
        if (inside && !within) begin = marks[i - 1];
        within = inside || (within && marks[i] == marks[i - 1]);
        if (within && marks[i] - begin > to - from) {
            from = begin;
            to = marks[i];
        }
    }
    if (to < from) return {};
    if (from == 0 && to == at) return {path.begin(), path.end()};
    return part_of(path, from, to);
}

Path convex_hull(std::vector<Point> points) {
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Path hull;
    const auto add = [&](const Point& p, std::size_t least) {
        while (hull.size() >= least && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
        hull.push_back(p);
    };
    for (const Point& p : points) add(p, 2);
    const std::size_t lower = hull.size() + 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
    hull.pop_back();
    return hull;
}

}  // namespace geomend::gridding
