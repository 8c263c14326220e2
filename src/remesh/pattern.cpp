// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/vectors.h"
#include "remesh/isotropic.h"

namespace geomend::remeshing {

namespace {

/// The worst shape of triangles that take the place of others; negative where one of them faces the other way.
double worst_shape(const FoldGuard& guard, std::span<const std::array<Vec3, 3>> triangles) {
    double worst = 1;
    for (const auto& [a, b, c] : triangles) {
        const bool turned = !(dot(cross(minus(b, a), minus(c, a)), guard.facing) > 0);
        worst = std::min(worst, turned ? -1 : shape_of(a, b, c));
    }
    return worst;
}

double shape_in_triangle(const EdgeMesh& mesh, std::uint32_t triangle, const Vec3& p) {
    const auto [a, b, c] = mesh.triangle(triangle);
    FoldGuard guard;
    guard.add(a, b, c);
    return worst_shape(guard, std::array<std::array<Vec3, 3>, 3>{{{a, b, p}, {b, c, p}, {c, a, p}}});
}

double shape_on_edge(const EdgeMesh& mesh, std::uint32_t h, const Vec3& p) {
    const Vec3 &a = mesh.places[mesh.from(h)], &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)];
    const Vec3& d = mesh.places[mesh.tip(mesh.twins[h])];
    FoldGuard guard;
    guard.add(a, b, c);
    guard.add(b, a, d);
    return worst_shape(guard, std::array<std::array<Vec3, 3>, 4>{{{a, p, c}, {p, b, c}, {b, p, d}, {p, a, d}}});
}

}  // namespace

std::uint32_t put_vertex(WorkSurface& work, const SurfacePoint& point, std::uint32_t from_triangle) {
    const EdgeMesh& mesh = work.mesh;
    const SurfacePoint at = closest_point(mesh, point.place, from_triangle);
    const std::uint32_t h = 3 * at.triangle;
    const auto greatest = static_cast<std::uint32_t>(std::ranges::max_element(at.weights) - at.weights.begin());
    if (at.weights[greatest] > 1 - 1e-6) {
        const std::uint32_t v = mesh.corners[h + greatest];
        if (work.kinds[v] == VertexKind::inner) work.kinds[v] = VertexKind::fixed;
        return v;
    }
    double best = shape_in_triangle(mesh, at.triangle, point.place);
    std::uint32_t edge = no_index;
    for (std::uint32_t e = h; e < h + 3; ++e) {
        if (mesh.twins[e] == no_index) continue;
        const double shape = shape_on_edge(mesh, e, point.place);
        if (shape <= best || at.weights[previous_of(e) % 3] > 1e-3) continue;
        best = shape;
        edge = e;
    }
    if (!(best > 1e-9)) return no_index;
    return edge != no_index ? add_on_edge(work, edge, point.place, point, VertexKind::fixed)
                            : add_in_triangle(work, at.triangle, point.place, point, VertexKind::fixed);
}

namespace {

/// The worst shape of the triangles around a vertex where it gives way to another one; 0 where one of them folds.
double shape_without(const WorkSurface& work, std::uint32_t gone, std::uint32_t stays) {
    const EdgeMesh& mesh = work.mesh;
    FoldGuard guard;
    visit_leaving(mesh, gone, [&](std::uint32_t h) { guard.add(mesh.places[gone], mesh.places[mesh.to(h)], mesh.places[mesh.tip(h)]); });
    double least = 1;
    visit_leaving(mesh, gone, [&](std::uint32_t h) {
        const std::uint32_t b = mesh.to(h), c = mesh.tip(h);
        if (b == stays || c == stays) return;
        const Vec3& place = mesh.places[stays];
        if (!guard.admits(place, mesh.places[b], mesh.places[c])) least = 0;
        else least = std::min(least, shape_of(place, mesh.places[b], mesh.places[c]));
    });
    return least;
}

/// Lets a vertex give way to that of its neighbours with which triangles have the best shapes.
bool remove_vertex(WorkSurface& work, std::uint32_t v, double least_shape) {
    const EdgeMesh& mesh = work.mesh;
    std::uint32_t best = no_index;
    double most = least_shape;
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        const double shape = shape_without(work, v, mesh.to(h));
        if (shape > most && can_collapse(mesh, h, v)) {
            most = shape;
            best = h;
        }
    });
    if (best == no_index) return false;
    collapse_edge(work.mesh, best, v);
    return true;
}

std::size_t remove_inner_vertices(WorkSurface& work, double least_shape) {
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < work.kinds.size(); ++v) {
        if (work.kinds[v] == VertexKind::inner && work.mesh.has_vertex(v) && remove_vertex(work, v, least_shape)) ++count;
    }
    return count;
}

void flip_all(WorkSurface& work) {
    for (int again = 0; again < 20 && flip_edges(work) > 0; ++again) {
    }
}

/// The corners of the two triangles at an edge: its ends, then its two tips.
std::array<std::uint32_t, 4> corners_at(const EdgeMesh& mesh, std::uint32_t h) {
    return {mesh.from(h), mesh.to(h), mesh.tip(h), mesh.tip(mesh.twins[h])};
}

/// Whether the surface does not fold where an edge is turned. \param least the cosine that its new triangles may have to the old ones
bool can_turn(std::span<const Vec3> places, const std::array<std::uint32_t, 4>& corners, double least) {
    const Vec3 &a = places[corners[0]], &b = places[corners[1]], &c = places[corners[2]], &d = places[corners[3]];
    FoldGuard guard;
    guard.add(a, b, c);
    guard.add(b, a, d);
    guard.least = least;
    return guard.admits(d, c, a) && guard.admits(c, d, b);
}

/// Turns edges towards Delaunay triangles of vertices that are elsewhere for it.
void turn_edges(WorkSurface& work, std::span<const Vec3> straight) {
    const EdgeMesh& mesh = work.mesh;
    const auto is_better_turned = [&](const std::array<std::uint32_t, 4>& corners) {
        const Vec3 &a = straight[corners[0]], &b = straight[corners[1]], &c = straight[corners[2]], &d = straight[corners[3]];
        if (!(cotangent(a, b, c) + cotangent(a, b, d) < -1e-6)) return false;
        return std::min(shape_of(d, c, a), shape_of(c, d, b)) > std::min(shape_of(a, b, c), shape_of(b, a, d));
    };
    constexpr int most_rounds = 20;
    std::size_t turned = 1;
    for (int round = 0; round < most_rounds && turned > 0; ++round) {
        turned = 0;
        for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
            if (mesh.corners[h] == no_index || mesh.twins[h] == no_index || h > mesh.twins[h]) continue;
            const auto corners = corners_at(mesh, h);
            constexpr double even = 0.7;
            if (!is_better_turned(corners) || !can_turn(straight, corners, even) || !can_turn(mesh.places, corners, even)) continue;
            if (!can_flip(mesh, h)) continue;
            flip_edge(work.mesh, h);
            ++turned;
        }
    }
}

/// Whether the two triangles at an edge are halves of a near-square, by the angles at its four corners, which is near flat.
bool is_near_square(std::span<const Vec3> places, const std::array<std::uint32_t, 4>& corners) {
    const Vec3 &a = places[corners[0]], &b = places[corners[1]], &c = places[corners[2]], &d = places[corners[3]];
    constexpr double slant = 0.5;
    for (const double cot : {cotangent(a, b, c), cotangent(b, a, d), cotangent(c, d, a), cotangent(d, c, b)}) {
        if (!(std::abs(cot) < slant)) return false;
    }
    return can_turn(places, corners, 0.9);
}

/// Cuts near-squares along the diagonals that the pattern wants. \param straight vertices where it is made of squares
void choose_diagonals(WorkSurface& work, std::span<const Vec3> straight, const Pattern& pattern, std::uint32_t surface) {
    const EdgeMesh& mesh = work.mesh;
    for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
        if (mesh.corners[h] == no_index || mesh.twins[h] == no_index || h > mesh.twins[h]) continue;
        const auto corners = corners_at(mesh, h);
        if (!is_near_square(straight, corners) || !can_turn(mesh.places, corners, 0.9)) continue;
        const bool keeps = pattern.is_better(surface, mesh.places[corners[0]], mesh.places[corners[1]]);
        const bool turns = pattern.is_better(surface, mesh.places[corners[2]], mesh.places[corners[3]]);
        if (!keeps && turns && can_flip(mesh, h)) flip_edge(work.mesh, h);
    }
}

}  // namespace

void leave_fixed_vertices(WorkSurface& work) {
    for (const double least_shape : {0.2, 0.05, 0.01, 0.001}) {
        std::size_t gone = 1;
        for (int again = 0; again < 10 && gone > 0; ++again) {
            flip_all(work);
            gone = remove_inner_vertices(work, least_shape) + remove_old_vertices(work);
        }
    }
    flip_all(work);
}

void remesh_to_pattern(WorkSurface& work, const Pattern& pattern, std::uint32_t surface, double size) {
    std::vector<Vec3> taken;
    for (std::uint32_t v = 0; v < work.reference->places.size(); ++v) {
        if (work.kinds[v] != VertexKind::inner || work.reference_sizes.at[v] >= 0.9 * size) continue;
        work.kinds[v] = VertexKind::fixed;
        taken.push_back(work.reference->places[v]);
    }
    for (const SurfacePoint& point : pattern.on_surface(surface, *work.reference, taken)) put_vertex(work, point, point.triangle);
    leave_fixed_vertices(work);
    std::vector<Vec3> straight;
    if (pattern.straightened) straight = pattern.straightened(surface, work.mesh.places);
    if (!straight.empty()) turn_edges(work, straight);
    if (pattern.is_better) choose_diagonals(work, straight.empty() ? work.mesh.places : straight, pattern, surface);
}

}  // namespace geomend::remeshing
