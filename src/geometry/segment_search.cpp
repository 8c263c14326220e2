// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/segment_search.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace geomend {

namespace {

constexpr std::uint32_t leaf = 4;

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross(const Vec3& a, const Vec3& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }

}  // namespace

SegmentSearch::SegmentSearch(std::span<const Vec3> points, std::span<const Triangle> triangles)
    : points_(points), triangles_(triangles), order_(triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (triangles.empty()) return;
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(triangles.size()));
}

// Halves at the middle of the longest side of the box of centres: at most as deep as the logarithm.
void SegmentSearch::build(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
    constexpr double far = std::numeric_limits<double>::max();
    Vec3 low{far, far, far}, high{-far, -far, -far}, centre_low = low, centre_high = high;
    const auto centre = [&](std::uint32_t t, std::size_t a) {
        const Triangle& c = triangles_[t];
        return points_[c[0]][a] + points_[c[1]][a] + points_[c[2]][a];
    };
    for (std::uint32_t i = first; i < last; ++i) {
        for (std::size_t a = 0; a < 3; ++a) {
            for (const std::uint32_t p : triangles_[order_[i]]) {
                low[a] = std::min(low[a], points_[p][a]);
                high[a] = std::max(high[a], points_[p][a]);
            }
            centre_low[a] = std::min(centre_low[a], centre(order_[i], a));
            centre_high[a] = std::max(centre_high[a], centre(order_[i], a));
        }
    }
    nodes_[node].low = low;
    nodes_[node].high = high;
    if (last - first <= leaf) {
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        return;
    }
    const Vec3 size = minus(centre_high, centre_low);
    const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](std::uint32_t a, std::uint32_t b) {
        const double x = centre(a, axis), y = centre(b, axis);
        return x < y || (x == y && a < b);
    });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = children;
    build(children, first, middle);
    build(children + 1, middle, last);
}

bool SegmentSearch::meets(const Node& node, const Vec3& from, const Vec3& direction, double most) {
    double begin = 0, end = most;
    for (std::size_t a = 0; a < 3; ++a) {
        if (direction[a] == 0) {
            if (from[a] < node.low[a] || from[a] > node.high[a]) return false;
            continue;
        }
        double enters = (node.low[a] - from[a]) / direction[a], leaves = (node.high[a] - from[a]) / direction[a];
        if (enters > leaves) std::swap(enters, leaves);
        // Flat boxes are met although their two sides round apart.
        const double slack = 1e-12 * most;
        begin = std::max(begin, enters - slack);
        end = std::min(end, leaves + slack);
        if (begin > end) return false;
    }
    return true;
}

// Moeller and Trumbore 1997: solves from + t direction = a + u (b-a) + v (c-a).
bool SegmentSearch::passes(std::uint32_t triangle, const Vec3& from, const Vec3& direction, double& t) const {
    const Triangle& corners = triangles_[triangle];
    const Vec3 &a = points_[corners[0]], ab = minus(points_[corners[1]], a), ac = minus(points_[corners[2]], a);
    const Vec3 p = cross(direction, ac);
    const double determinant = dot(ab, p);
    if (determinant == 0) return false;
    const Vec3 to = minus(from, a);
    const double u = dot(to, p) / determinant;
    if (!(u >= 0 && u <= 1)) return false;
    const Vec3 q = cross(to, ab);
    const double v = dot(direction, q) / determinant;
    if (!(v >= 0 && u + v <= 1)) return false;
    t = dot(ac, q) / determinant;
    return true;
}

}  // namespace geomend
