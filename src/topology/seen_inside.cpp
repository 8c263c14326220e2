// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/seen_inside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace geomend::topology {

namespace {

/// An edge of a triangle, from its lower vertex on.
struct EdgeOfTriangle {
    std::uint32_t low, high, triangle;
    bool forward;  ///< the triangle goes from low to high
};

/// Two triangles at an edge.
struct NeighbourAt {
    std::uint32_t triangle;
    bool wound_alike;
};

/// Per triangle its neighbours at its edges; empty where an edge has another number of triangles than two.
std::vector<std::vector<NeighbourAt>> closed_neighbours(const UsedPoints& used, std::span<const std::uint32_t> triangles) {
    std::vector<EdgeOfTriangle> edges;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& t = used.triangles[triangles[i]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), i, a < b});
        }
    }
    std::ranges::sort(
        edges, [](const auto& a, const auto& b) { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
    std::vector<std::vector<NeighbourAt>> neighbours(triangles.size());
    const auto is_same = [](const EdgeOfTriangle& a, const EdgeOfTriangle& b) { return a.low == b.low && a.high == b.high; };
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        if (i + 1 == edges.size() || !is_same(edges[i], edges[i + 1])) return {};
        if (i + 2 < edges.size() && is_same(edges[i], edges[i + 2])) return {};
        const EdgeOfTriangle &a = edges[i], &b = edges[i + 1];
        neighbours[a.triangle].push_back({b.triangle, a.forward != b.forward});
        neighbours[b.triangle].push_back({a.triangle, a.forward != b.forward});
    }
    return neighbours;
}

/// Per triangle 1 or -1, so that all are wound one way; empty where they cannot be, or are in several parts.
std::vector<int> one_winding(const std::vector<std::vector<NeighbourAt>>& neighbours) {
    std::vector<int> sign(neighbours.size(), 0);
    std::vector<std::uint32_t> next = {0};
    sign[0] = 1;
    std::size_t reached = 1;
    while (!next.empty()) {
        const std::uint32_t t = next.back();
        next.pop_back();
        for (const NeighbourAt& n : neighbours[t]) {
            const int wanted = n.wound_alike ? sign[t] : -sign[t];
            if (sign[n.triangle] == 0) {
                sign[n.triangle] = wanted;
                next.push_back(n.triangle);
                ++reached;
            } else if (sign[n.triangle] != wanted) {
                return {};
            }
        }
    }
    if (reached < sign.size()) sign.clear();
    return sign;
}

/// The side of a triangle that a point sees: 1, -1, or 0 where it sees the edge only.
int side_seen(const std::array<Vec3, 3>& corners, const Vec3& from) {
    constexpr double rounding = 1e-12;
    const Vec3 a = minus(corners[0], from), b = minus(corners[1], from), c = minus(corners[2], from);
    const double volume = dot(a, cross(b, c)), scale = std::sqrt(dot(a, a) * dot(b, b) * dot(c, c));
    return std::abs(volume) <= rounding * scale ? 0 : volume > 0 ? 1 : -1;
}

}  // namespace

bool is_body_seen_from(const UsedPoints& used, std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> vertices) {
    std::vector<std::uint32_t> whole;
    for (const std::uint32_t t : triangles) {
        const auto& [a, b, c] = used.triangles[t];
        if (a != b && b != c && c != a) whole.push_back(t);
    }
    const auto neighbours = closed_neighbours(used, whole);
    if (neighbours.empty()) return false;
    const std::vector<int> sign = one_winding(neighbours);
    if (sign.empty()) return false;
    int side = 0;
    for (const std::uint32_t v : vertices) {
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const auto& t = used.triangles[whole[i]];
            if (std::ranges::find(t, v) != t.end()) continue;
            const int seen = sign[i] * side_seen(used.corners(whole[i]), used.positions[v]);
            if (seen != 0 && side == -seen) return false;
            if (seen != 0) side = seen;
        }
    }
    return side != 0;
}

}  // namespace geomend::topology
