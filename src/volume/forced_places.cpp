// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/forced_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/bounds.h"
#include "base/length.h"
#include "base/vectors.h"
#include "geometry/closest_points.h"
#include "volume/sharp_edges.h"

namespace geomend::volumes {

namespace {

Vec3 normal_of(const std::array<Vec3, 3>& t) {
    const Vec3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double size = length(n);
    return size > 0 ? times(1 / size, n) : Vec3{};
}

}  // namespace

ForcedPlaces::ForcedPlaces(const RegionFacets& facets, double size)
    : facets_(facets),
      size_(size),
      tree_(facets.positions, facets.triangles),
      sharp_(facets.triangles.size()),
      facing_(facets.triangles.size()),
      known_(facets.positions.size(), Known::unasked) {
    for (const SharpEdge& edge : sharp_edges(facets, 10 * std::numbers::pi / 180)) {
        for (const std::uint32_t f : edge.facets) sharp_[f].push_back(edge.ends);
    }
}

bool ForcedPlaces::is_near(std::uint32_t vertex, const Vec3& place) {
    if (vertex >= known_.size()) return is_near(place);
    Known& known = known_[vertex];
    if (known == Known::unasked) known = is_near(place) ? Known::near : Known::far;
    return known == Known::near;
}

std::array<Vec3, 3> ForcedPlaces::corners(std::uint32_t f) const {
    const Triangle& t = facets_.triangles[f];
    return {facets_.positions[t[0]], facets_.positions[t[1]], facets_.positions[t[2]]};
}

const std::vector<std::uint32_t>& ForcedPlaces::facing(std::uint32_t f) {
    if (facing_[f]) return *facing_[f];
    std::vector<std::uint32_t>& found = facing_[f].emplace();
    const auto t = corners(f);
    const Bounds around = bounds_around(t);
    tree_.visit_triangles(tree_.box(around.low, around.high, size_ / 2), [&](std::size_t i) {
        const std::uint32_t other = tree_.number(i);
        for (const std::uint32_t v : facets_.triangles[other]) {
            if (std::ranges::find(facets_.triangles[f], v) != facets_.triangles[f].end()) return;
        }
        if (are_opposite(closest_points(t, corners(other)), f, other)) found.push_back(other);
    });
    return found;
}

bool ForcedPlaces::are_opposite(const Closest& gap, std::uint32_t a, std::uint32_t b) const {
    if (!(gap.distance < size_ / 2) || !(gap.distance > 0)) return false;
    const auto faces = [&](std::uint32_t f) { return std::abs(dot(normal_of(corners(f)), gap.apart)) > 0.5 * gap.distance; };
    return faces(a) && faces(b);
}

bool ForcedPlaces::is_near(const Vec3& p) {
    bool found = false;
    tree_.visit_triangles(tree_.box(p, p, size_), [&](std::size_t i) {
        if (found || tree_.is_farther(p, i, size_)) return;
        const std::uint32_t f = tree_.number(i);
        const Closest foot = closest_points(p, corners(f));
        if (foot.distance > size_) return;
        for (const Edge& edge : sharp_[f]) found = found || is_beside(p, edge);
        for (const std::uint32_t other : facing(f)) {
            if (found) break;
            found = are_opposite(closest_points(foot.on_second, corners(other)), f, other);
        }
    });
    return found;
}

bool ForcedPlaces::is_beside(const Vec3& p, const Edge& edge) const {
    const Vec3 d = minus(p, facets_.positions[edge[0]]), along = minus(facets_.positions[edge[1]], facets_.positions[edge[0]]);
    const double share = std::clamp(dot(d, along) / dot(along, along), 0.0, 1.0);
    return length(minus(d, times(share, along))) <= size_;
}

}  // namespace geomend::volumes
