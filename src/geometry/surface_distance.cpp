// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/surface_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "geometry/vectors.h"

namespace geomend {

namespace {

/// The first and the last corner of a part: the same one twice for a corner.
std::array<std::uint32_t, 2> ends_of(const Triangle& t, unsigned part) {
    const auto first = static_cast<std::size_t>(std::countr_zero(part)), last = static_cast<std::size_t>(std::bit_width(part) - 1);
    return {t[first], t[last]};
}

}  // namespace

SurfaceDistance::SurfaceDistance(const TriangleTree& tree, std::span<const std::uint32_t> groups)
    : tree_(tree), vertices_(tree.vertices()), groups_(tree.size()), around_(vertices_.size(), tree.triangles()) {
    parallel_blocks(tree.size(), 4096, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i != to; ++i) groups_[i] = groups[tree.number(i)];
    });
}

bool SurfaceDistance::on_group(std::uint32_t vertex, std::uint32_t group) const {
    return std::ranges::any_of(around_.at(vertex), [&](std::uint32_t t) { return groups_[t] == group; });
}

std::vector<std::uint32_t> SurfaceDistance::groups_at(std::uint32_t vertex) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : around_.at(vertex)) {
        if (std::find(found.begin(), found.end(), groups_[t]) == found.end()) found.push_back(groups_[t]);
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::uint32_t> SurfaceDistance::around_part(std::uint32_t t, unsigned part, std::uint32_t group) const {
    const auto [p, q] = ends_of(tree_.triangle(t), part);
    if (part == 7) return {t};
    return around_edge(p, q, group);
}

std::vector<std::uint32_t> SurfaceDistance::groups_around_part(std::uint32_t t, unsigned part) const {
    if (part == 7) return {groups_[t]};
    const auto [p, q] = ends_of(tree_.triangle(t), part);
    std::vector<std::uint32_t> found;
    for (const std::uint32_t other : around_.at(p)) {
        if (has(other, q)) found.push_back(groups_[other]);
    }
    return found;
}

std::vector<std::uint32_t> SurfaceDistance::around_edge(std::uint32_t p, std::uint32_t q, std::uint32_t group) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : around_.at(p)) {
        if (groups_[t] == group && has(t, q)) found.push_back(t);
    }
    return found;
}

bool SurfaceDistance::none_ahead(const Vec3& point, std::uint32_t p, std::uint32_t q, std::uint32_t group, const Vec3& direction) const {
    const double slack = rounding(point) * std::sqrt(dot(direction, direction));
    const auto is_ahead = [&](std::uint32_t v) {
        const Vec3 d = minus(vertices_[v], point);
        return v != p && v != q && dot(d, direction) > slack + 1e-15 * dot(d, d);
    };
    return std::ranges::none_of(around_.at(p), [&](std::uint32_t t) {
        const Triangle& corners = tree_.triangle(t);
        return groups_[t] == group && has(t, q) && std::ranges::any_of(corners, is_ahead);
    });
}

bool SurfaceDistance::none_ahead_at_part(const Vec3& point, std::uint32_t t, unsigned part, const Vec3& direction) const {
    const auto [p, q] = ends_of(tree_.triangle(t), part);
    return part == 7 || none_ahead(point, p, q, groups_[t], direction);
}

Closest SurfaceDistance::from_group(const Vec3& point, std::uint32_t group, double near, std::uint32_t& triangle) const {
    Closest best;
    best.distance = HUGE_VAL;
    tree_.visit_triangles(tree_.box(point, point, near), [&](std::size_t i) {
        const auto t = static_cast<std::uint32_t>(i);
        if (groups_[t] != group || tree_.is_farther(point, i, std::min(near, best.distance))) return;
        const Closest found = closest_points(point, corners(t));
        if (found.distance >= near || found.distance >= best.distance) return;
        best = found;
        triangle = t;
    });
    return best;
}

bool SurfaceDistance::common_vertex_within(double distance, const Vec3& point, std::uint32_t group_a, std::uint32_t group_b) const {
    bool found = false;
    tree_.visit_triangles(tree_.box(point, point, distance), [&](std::size_t i) {
        if (found || groups_[i] != group_b) return;
        for (const std::uint32_t v : tree_.triangle(i)) {
            const Vec3 d = minus(vertices_[v], point);
            found = found || (dot(d, d) <= distance * distance && on_group(v, group_a));
        }
    });
    return found;
}

double SurfaceDistance::rounding(const Vec3& point) const {
    return 1e-15 * std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
}

}  // namespace geomend
