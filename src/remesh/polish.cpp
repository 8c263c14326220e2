// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/polish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/length.h"
#include "base/vectors.h"

namespace geomend::remeshing {

namespace {

constexpr unsigned most_rounds = 8;
constexpr double gain = 0.002;           ///< radians: less is none
constexpr double longest_by_size = 1.6;  ///< no edge becomes longer

/// The least angle of a triangle in radians.
double least_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(b, a), v = minus(c, b), w = minus(a, c);
    const double twice = length(cross(u, v));
    return std::min({std::atan2(twice, -dot(u, v)), std::atan2(twice, -dot(v, w)), std::atan2(twice, -dot(w, u))});
}

double least_angle(const EdgeMesh& mesh, std::uint32_t t) {
    const auto p = mesh.triangle(t);
    return least_angle(p[0], p[1], p[2]);
}

/// The triangles around a vertex before something is done to it.
struct Around {
    FoldGuard guard;
    double least = std::numbers::pi;
};

Around around(const EdgeMesh& mesh, std::uint32_t v) {
    Around all;
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        const Vec3 &a = mesh.places[v], &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)];
        all.guard.add(a, b, c);
        all.least = std::min(all.least, least_angle(a, b, c));
    });
    all.guard.least = 0.5;
    return all;
}

bool turn(WorkSurface& work, std::uint32_t h) {
    EdgeMesh& mesh = work.mesh;
    const std::uint32_t g = mesh.twins[h];
    if (g == no_index) return false;
    const Vec3 &a = mesh.places[mesh.from(h)], &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)], &d = mesh.places[mesh.tip(g)];
    const double before = std::min(least_angle(a, b, c), least_angle(b, a, d)),
                 after = std::min(least_angle(d, c, a), least_angle(c, d, b));
    if (!(after > before + gain)) return false;
    FoldGuard guard;
    guard.add(a, b, c);
    guard.add(b, a, d);
    guard.least = 0.7;
    if (!guard.admits(d, c, a) || !guard.admits(c, d, b) || !can_flip(mesh, h)) return false;
    flip_edge(mesh, h);
    return true;
}

/// Lets a vertex give way to the other end of an edge.
bool give_way(WorkSurface& work, std::uint32_t h, std::uint32_t gone) {
    EdgeMesh& mesh = work.mesh;
    const std::uint32_t stays = mesh.from(h) == gone ? mesh.to(h) : mesh.from(h);
    if (work.kinds[gone] != VertexKind::inner || !can_collapse(mesh, h, gone)) return false;
    const Around before = around(mesh, gone);
    const Vec3& place = mesh.places[stays];
    bool is_better = true;
    visit_leaving(mesh, gone, [&](std::uint32_t e) {
        const std::uint32_t b = mesh.to(e), c = mesh.tip(e);
        if (!is_better || b == stays || c == stays) return;
        is_better = least_angle(place, mesh.places[b], mesh.places[c]) > before.least + gain &&
                    before.guard.admits(place, mesh.places[b], mesh.places[c]);
        for (const std::uint32_t v : {b, c})
            is_better = is_better && length(minus(mesh.places[v], place)) <= longest_by_size * (work.sizes[v] + work.sizes[stays]) / 2;
    });
    if (!is_better) return false;
    collapse_edge(mesh, h, gone);
    return true;
}

/// The least angle around a vertex if it were elsewhere; below 0 where something would fold.
double least_at(const EdgeMesh& mesh, std::uint32_t v, const Vec3& place, const FoldGuard& guard) {
    double least = std::numbers::pi;
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        if (least < 0) return;
        const Vec3 &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)];
        least = guard.admits(place, b, c) ? std::min(least, least_angle(place, b, c)) : -1;
    });
    return least;
}

/// Moves a vertex along the surface to where the least angle around it is larger, in ever smaller steps.
bool move_better(WorkSurface& work, std::uint32_t v) {
    EdgeMesh& mesh = work.mesh;
    if (work.kinds[v] != VertexKind::inner) return false;
    const Around before = around(mesh, v);
    const double square = dot(before.guard.facing, before.guard.facing);
    if (!(square > 0)) return false;
    double step = HUGE_VAL, best = before.least;
    Vec3 along{};
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        const Vec3 d = minus(mesh.places[mesh.to(h)], mesh.places[v]);
        if (length(d) >= step) return;
        step = length(d);
        along = d;
    });
    const Vec3 normal = times(1 / std::sqrt(square), before.guard.facing);
    along = minus(along, times(dot(along, normal), normal));
    if (!(length(along) > 0)) return false;
    along = times(1 / length(along), along);
    const Vec3 across = cross(normal, along);
    SurfacePoint to;
    to.place = mesh.places[v];
    to.triangle = work.triangles[v];
    bool moved = false;
    step *= 0.4;
    for (unsigned smaller = 0; smaller < 4; ++smaller, step /= 2) {
        const SurfacePoint from = to;
        for (unsigned k = 0; k < 8; ++k) {
            const double angle = std::numbers::pi / 4 * k;
            const Vec3 there = plus(from.place, plus(times(step * std::cos(angle), along), times(step * std::sin(angle), across)));
            const SurfacePoint at = closest_point(*work.reference, there, from.triangle);
            const double least = least_at(mesh, v, at.place, before.guard);
            if (!(least > best + gain)) continue;
            best = least;
            to = at;
            moved = true;
        }
    }
    if (moved) put_at(work, v, to);
    return moved;
}

bool polish(WorkSurface& work, std::uint32_t t) {
    const EdgeMesh& mesh = work.mesh;
    std::array<std::uint32_t, 3> edges{3 * t, 3 * t + 1, 3 * t + 2};
    const auto edge_length = [&](std::uint32_t h) { return length(minus(mesh.places[mesh.to(h)], mesh.places[mesh.from(h)])); };
    std::ranges::sort(edges, {}, edge_length);
    if (turn(work, edges[2]) || turn(work, edges[1]) || turn(work, edges[0])) return true;
    for (const std::uint32_t h : edges) {
        if (mesh.twins[h] != no_index && (give_way(work, h, mesh.from(h)) || give_way(work, h, mesh.to(h)))) return true;
    }
    bool moved = false;
    for (const std::uint32_t h : edges) moved = move_better(work, mesh.from(h)) || moved;
    return moved;
}

}  // namespace

std::size_t polish_triangles(WorkSurface& work, double degrees) {
    const double wanted = degrees * std::numbers::pi / 180;
    std::size_t count = 0;
    for (unsigned round = 0; round < most_rounds; ++round) {
        const std::size_t before = count;
        for (std::uint32_t t = 0; t < work.mesh.triangle_count() && !work.stopped_at(t); ++t) {
            if (work.mesh.has_triangle(t) && least_angle(work.mesh, t) < wanted && polish(work, t)) ++count;
        }
        if (count == before) break;
    }
    return count;
}

}  // namespace geomend::remeshing
