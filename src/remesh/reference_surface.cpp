// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/reference_surface.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <vector>

#include "base/vectors.h"

namespace geomend::remeshing {

namespace {

/// The closest point of a triangle, and the part of it that has it: bit k for corner k.
struct Foot {
    Weights weights{};
    double square = HUGE_VAL;
    unsigned part = 0;
};

Foot foot_on_edge(const std::array<Vec3, 3>& t, const Vec3& point, unsigned i, unsigned j) {
    const Vec3 along = minus(t[j], t[i]), to = minus(point, t[i]);
    const double whole = dot(along, along);
    double share = whole > 0 ? dot(to, along) / whole : 0;
    Foot foot;
    foot.part = 1u << i | 1u << j;
    if (!(share > 0)) {
        share = 0;
        foot.part = 1u << i;
    } else if (share >= 1) {
        share = 1;
        foot.part = 1u << j;
    }
    const Vec3 off = minus(to, times(share, along));
    foot.square = dot(off, off);
    foot.weights[i] = 1 - share;
    foot.weights[j] = share;
    return foot;
}

Foot foot_on(const std::array<Vec3, 3>& t, const Vec3& point) {
    const Vec3 u = minus(t[1], t[0]), v = minus(t[2], t[0]), d = minus(point, t[0]), normal = cross(u, v);
    const double square = dot(normal, normal);
    if (square > 1e-20 * dot(u, u) * dot(v, v)) {  // by the normal: products of lengths would say nothing of a needle
        const double b = dot(normal, cross(d, v)) / square, c = dot(normal, cross(u, d)) / square, a = 1 - b - c;
        if (a >= 0 && b >= 0 && c >= 0) {
            const Vec3 off = minus(d, plus(times(b, u), times(c, v)));
            return {{a, b, c}, dot(off, off), 7};
        }
    }
    Foot best = foot_on_edge(t, point, 0, 1);
    for (const auto& [i, j] : {std::array<unsigned, 2>{1, 2}, {2, 0}}) {
        const Foot other = foot_on_edge(t, point, i, j);
        if (other.square < best.square) best = other;
    }
    return best;
}

unsigned corner_of(unsigned part) { return part == 1 ? 0 : part == 2 ? 1 : 2; }
/// The edge of a part of two corners: edge k runs from corner k to the next one.
unsigned edge_of(unsigned part) { return part == 3 ? 0 : part == 6 ? 1 : 2; }

}  // namespace

SurfacePoint point_at(const EdgeMesh& mesh, std::uint32_t triangle, const Weights& weights) {
    const auto t = mesh.triangle(triangle);
    const Vec3 off = plus(times(weights[1], minus(t[1], t[0])), times(weights[2], minus(t[2], t[0])));
    return {triangle, weights, plus(t[0], off), 0};
}

SurfacePoint closest_point(const EdgeMesh& mesh, const Vec3& point, std::uint32_t from_triangle) {
    std::uint32_t at = from_triangle;
    Foot best = foot_on(mesh.triangle(at), point);
    const auto try_triangle = [&](std::uint32_t t, std::uint32_t& next) {
        const Foot foot = foot_on(mesh.triangle(t), point);
        if (!(foot.square < best.square)) return;
        best = foot;
        next = t;
    };
    const auto try_around = [&](std::uint32_t v, std::uint32_t& next) {
        visit_leaving(mesh, v, [&](std::uint32_t h) { try_triangle(h / 3, next); });
    };
    while (best.part != 7) {
        std::uint32_t next = no_index;
        if (best.part == 1 || best.part == 2 || best.part == 4) {
            try_around(mesh.corners[3 * std::size_t{at} + corner_of(best.part)], next);
        } else {
            const std::uint32_t h = 3 * at + edge_of(best.part), back = mesh.twins[h];
            if (back != no_index) {
                try_triangle(back / 3, next);
                // A needle across the edge comes no nearer by itself, but what lies behind it does.
                if (next == no_index) try_around(mesh.from(h), next);
                if (next == no_index) try_around(mesh.to(h), next);
            }
        }
        if (next == no_index) break;
        at = next;
    }
    SurfacePoint found = point_at(mesh, at, best.weights);
    found.distance = std::sqrt(best.square);
    return found;
}

SurfacePoint closest_point_around(const EdgeMesh& mesh, const Vec3& point, std::uint32_t from_triangle, double least_reach) {
    // A needle's distance is that of its neighbour but for rounding.
    const double reach = std::max(foot_on(mesh.triangle(from_triangle), point).square, least_reach * least_reach) * (1 + 1e-6);
    std::vector<std::uint32_t> queue{from_triangle};
    std::unordered_set<std::uint32_t> seen{from_triangle};
    Foot best;
    std::uint32_t at = from_triangle;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const Foot foot = foot_on(mesh.triangle(queue[i]), point);
        if (foot.square < best.square) {
            best = foot;
            at = queue[i];
        }
        if (foot.square > reach) continue;
        for (std::uint32_t h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
            const std::uint32_t back = mesh.twins[h];
            if (back != no_index && seen.insert(back / 3).second) queue.push_back(back / 3);
        }
    }
    SurfacePoint found = point_at(mesh, at, best.weights);
    found.distance = std::sqrt(best.square);
    return found;
}

}  // namespace geomend::remeshing
