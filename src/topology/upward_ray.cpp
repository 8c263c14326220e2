// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/upward_ray.h"

#include <algorithm>

#include "geometry/predicates.h"

namespace geomend::topology {

UpwardRay::UpwardRay(const BrepData& brep) : brep_(brep) {
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            const auto at = [&](std::size_t k) { return surface.nodes[polygon[k]].value; };
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                triangles_.push_back({at(0), at(k), at(k + 1)});
                surface_.push_back(s);
            }
        }
    }
    for (std::size_t v = 0; v < brep.vertices.size(); ++v) top_ = v == 0 ? brep.vertices[v][2] : std::max(top_, brep.vertices[v][2]);
    tree_.emplace(brep.vertices, triangles_);
}

namespace {

/// Which side of the way from a to b a point is on, seen from above: +1 to the left. Where it is on the way, the side on which it
/// would be a very little farther along x, and along y by very little of that. 0 where the way runs straight up.
int turn(const Vec3& a, const Vec3& b, const Vec3& point) {
    const int sign = orientation_2d(a, b, point, 2);
    if (sign != 0) return sign;
    if (a[1] != b[1]) return b[1] < a[1] ? 1 : -1;
    return a[0] == b[0] ? 0 : a[0] < b[0] ? 1 : -1;
}

}  // namespace

std::optional<std::vector<UpwardRay::Hit>> UpwardRay::above(const Vec3& point, const std::function<bool(std::uint32_t)>& counts) const {
    std::vector<Hit> hits;
    bool lies_on_one = false;
    tree_->visit_triangles(tree_->box(point, {point[0], point[1], std::max(point[2], top_)}), [&](std::size_t i) {
        const Triangle& t = tree_->triangle(i);
        const Vec3 &a = brep_.vertices[t[0]], &b = brep_.vertices[t[1]], &c = brep_.vertices[t[2]];
        const int sense = turn(a, b, point);
        if (sense == 0 || turn(b, c, point) != sense || turn(c, a, point) != sense) return;  // beside it
        if (!counts(surface_[tree_->number(i)])) return;
        const int side = orientation(a, b, c, point);
        if (side == 0) lies_on_one = true;
        if (side * sense < 0) hits.push_back({surface_[tree_->number(i)], sense});
    });
    if (lies_on_one) return std::nullopt;
    return hits;
}

}  // namespace geomend::topology
