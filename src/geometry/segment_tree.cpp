// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/segment_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/vectors.h"

namespace geomend {

namespace {

Vec3 place_along(const Segment& s, double along) {
    if (along <= 0) return s[0];
    if (along >= 1) return s[1];
    return plus(s[0], times(along, minus(s[1], s[0])));
}

/// Where on a segment the point closest to p lies.
double closest_along(const Segment& s, const Vec3& p) {
    const Vec3 d = minus(s[1], s[0]);
    const double square = dot(d, d);
    return square > 0 ? std::clamp(dot(minus(p, s[0]), d) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

SegmentDistance closest_points(const Segment& first, const Segment& second) {
    SegmentDistance best;
    best.distance = HUGE_VAL;
    const auto try_place = [&](double along_first, double along_second) {
        const Vec3 p = place_along(first, along_first), q = place_along(second, along_second);
        const Vec3 d = minus(p, q);
        const double distance = std::sqrt(dot(d, d));
        if (distance < best.distance) best = {distance, along_first, along_second, p, q};
    };
    // Between inner points the shortest way is square to both; else it ends at an end.
    const Vec3 d1 = minus(first[1], first[0]), d2 = minus(second[1], second[0]), r = minus(second[0], first[0]);
    const Vec3 n = cross(d1, d2);
    const double square = dot(n, n);
    if (square > 0) {
        const double s = dot(cross(r, d2), n) / square, t = dot(cross(r, d1), n) / square;
        if (s > 0 && s < 1 && t > 0 && t < 1) try_place(s, t);
    }
    for (const double end : {0.0, 1.0}) {
        try_place(end, closest_along(second, place_along(first, end)));
        try_place(closest_along(first, place_along(second, end)), end);
    }
    return best;
}

SideBySide side_by_side(const Segment& first, const Segment& second, double distance) {
    const Vec3 d = minus(first[1], first[0]);
    const double length = std::sqrt(dot(d, d));
    // From where to where the second one runs along the first.
    const double a = dot(minus(second[0], first[0]), d) / (length * length), b = dot(minus(second[1], first[0]), d) / (length * length);
    const double from = std::max(0.0, std::min(a, b)), to = std::min(1.0, std::max(a, b));
    if (!(to > from)) return {};
    const auto apart = [&](double along) {
        const double on_second = a == b ? 0.0 : std::clamp((along - a) / (b - a), 0.0, 1.0);
        const Vec3 way = minus(place_along(first, along), place_along(second, on_second));
        return std::sqrt(dot(way, way));
    };
    if (apart(from) > distance || apart(to) > distance) return {};
    return {(to - from) * length, {place_along(first, from), place_along(first, to)}};
}

SegmentTree::SegmentTree(std::span<const Segment> segments, double distance) : order_(segments.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(segments.size());
    if (!segments.empty()) build(segments, 0, static_cast<std::uint32_t>(segments.size()), distance);
}

std::uint32_t SegmentTree::build(std::span<const Segment> segments, std::uint32_t first, std::uint32_t last, double distance) {
    const auto n = static_cast<std::uint32_t>(nodes_.size());
    Node node{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, first, last, 0};
    Vec3 low = node.low, high = node.high;  // of the middles, doubled
    for (std::uint32_t i = first; i < last; ++i) {
        const Segment& s = segments[order_[i]];
        for (std::size_t k = 0; k < 3; ++k) {
            node.low[k] = std::min(node.low[k], std::min(s[0][k], s[1][k]) - distance / 2);
            node.high[k] = std::max(node.high[k], std::max(s[0][k], s[1][k]) + distance / 2);
            low[k] = std::min(low[k], s[0][k] + s[1][k]);
            high[k] = std::max(high[k], s[0][k] + s[1][k]);
        }
    }
    nodes_.push_back(node);
    if (last - first <= leaf_size) return n;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    const auto begin = order_.begin();
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(begin + first, begin + middle, begin + last, [&](std::uint32_t a, std::uint32_t b) {
        const double x = segments[a][0][axis] + segments[a][1][axis], y = segments[b][0][axis] + segments[b][1][axis];
        return x != y ? x < y : a < b;
    });
    build(segments, first, middle, distance);
    const std::uint32_t second = build(segments, middle, last, distance);
    nodes_[n].second_child = second;
    return n;
}

}  // namespace geomend
