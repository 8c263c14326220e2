// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/sharp_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/length.h"
#include "base/vectors.h"

namespace geomend::volumes {

namespace {

using Ends = std::array<std::uint32_t, 2>;

/// The angle between two facets at an edge of both; more than any where the region is not between them.
double angle_between(const RegionFacets& facets, std::uint32_t a, std::uint32_t b, const Ends& edge) {
    const Vec3 &from = facets.positions[edge[0]], along = minus(facets.positions[edge[1]], from);
    const auto across = [&](std::uint32_t f) {
        for (const std::uint32_t c : facets.triangles[f]) {
            if (c == edge[0] || c == edge[1]) continue;
            const Vec3 d = minus(facets.positions[c], from);
            return minus(d, times(dot(d, along) / dot(along, along), along));
        }
        return Vec3{};
    };
    const Vec3 p = across(a), q = across(b);
    const Triangle& t = facets.triangles[a];
    const Vec3 normal = cross(minus(facets.positions[t[1]], facets.positions[t[0]]), minus(facets.positions[t[2]], facets.positions[t[0]]));
    const double side = dot(normal, q);
    if (side != 0 && (facets.sides[a] & (side > 0 ? in_front : behind)) == 0) return HUGE_VAL;
    return std::atan2(length(cross(p, q)), dot(p, q));
}

}  // namespace

std::vector<SharpEdge> sharp_edges(const RegionFacets& facets, double below) {
    std::vector<std::pair<Ends, std::uint32_t>> edges;
    edges.reserve(3 * facets.triangles.size());
    for (std::uint32_t f = 0; f < facets.triangles.size(); ++f) {
        const Triangle& t = facets.triangles[f];
        for (std::size_t k = 0; k < 3; ++k) edges.push_back({{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}, f});
    }
    std::ranges::sort(edges);
    std::vector<SharpEdge> found;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (std::size_t j = i + 1; j < edges.size() && edges[j].first == edges[i].first; ++j) {
            const double angle = angle_between(facets, edges[i].second, edges[j].second, edges[i].first);
            if (angle < below) found.push_back({edges[i].first, {edges[i].second, edges[j].second}, angle});
        }
    }
    return found;
}

}  // namespace geomend::volumes
