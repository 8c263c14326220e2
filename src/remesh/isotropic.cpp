// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/isotropic.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/vectors.h"
#include "remesh/polish.h"

namespace geomend::remeshing {

namespace {

constexpr double too_long = 4.0 / 3, too_short = 4.0 / 5;

double square_length(const EdgeMesh& mesh, std::uint32_t h) {
    const Vec3 d = minus(mesh.places[mesh.to(h)], mesh.places[mesh.from(h)]);
    return dot(d, d);
}

double wanted(const WorkSurface& work, std::uint32_t h) { return (work.sizes[work.mesh.from(h)] + work.sizes[work.mesh.to(h)]) / 2; }

/// Each edge once: its half-edge with the lower number, or that on a border.
bool stands_for_edge(const EdgeMesh& mesh, std::uint32_t h) {
    return mesh.corners[h] != no_index && (mesh.twins[h] == no_index || h < mesh.twins[h]);
}

/// Whether triangles stay facing where one end of an edge gives way to the other, in a fair shape and with edges that are not too long.
bool collapse_keeps_shape(const WorkSurface& work, std::uint32_t gone, std::uint32_t stays, bool any_length) {
    const EdgeMesh& mesh = work.mesh;
    FoldGuard guard;
    double least_shape = 1;
    visit_leaving(mesh, gone, [&](std::uint32_t h) {
        const Vec3 &a = mesh.places[gone], &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)];
        guard.add(a, b, c);
        least_shape = std::min(least_shape, shape_of(a, b, c));
    });
    const double fair = std::min(0.2, least_shape);
    const Vec3& place = mesh.places[stays];
    bool keeps = true;
    visit_leaving(mesh, gone, [&](std::uint32_t h) {
        const std::uint32_t b = mesh.to(h), c = mesh.tip(h);
        if (!keeps || b == stays || c == stays) return;
        keeps = guard.admits(place, mesh.places[b], mesh.places[c]) && shape_of(place, mesh.places[b], mesh.places[c]) > fair * 0.999;
        if (!keeps || any_length) return;
        for (const std::uint32_t v : {b, c}) {
            const Vec3 d = minus(mesh.places[v], place);
            const double most = too_long * (work.sizes[v] + work.sizes[stays]) / 2;
            keeps = keeps && dot(d, d) <= most * most;
        }
    });
    return keeps;
}

bool try_collapse(WorkSurface& work, std::uint32_t h, std::uint32_t gone, bool any_length) {
    const std::uint32_t stays = work.mesh.from(h) == gone ? work.mesh.to(h) : work.mesh.from(h);
    if (!can_collapse(work.mesh, h, gone) || !collapse_keeps_shape(work, gone, stays, any_length)) return false;
    collapse_edge(work.mesh, h, gone);
    return true;
}

/// The half-edge of the border that leads to a vertex of it.
std::uint32_t border_to(const EdgeMesh& mesh, std::uint32_t v) {
    std::uint32_t last = no_index;
    visit_leaving(mesh, v, [&](std::uint32_t h) { last = h; });
    return previous_of(last);
}

bool remove_old(WorkSurface& work, std::uint32_t v) {
    const EdgeMesh& mesh = work.mesh;
    std::array<std::uint32_t, 2> edges{mesh.leaving[v], border_to(mesh, v)};
    const auto is_worse = [&](std::uint32_t h, std::uint32_t g) {
        const auto is_old = [&](std::uint32_t e) { return work.kinds[mesh.from(e) == v ? mesh.to(e) : mesh.from(e)] == VertexKind::old; };
        if (is_old(h) != is_old(g)) return is_old(h);
        return square_length(mesh, h) > square_length(mesh, g);
    };
    if (is_worse(edges[0], edges[1])) std::swap(edges[0], edges[1]);
    return try_collapse(work, edges[0], v, true) || try_collapse(work, edges[1], v, true);
}

/// Whether an edge is better turned: the angles that face it are more than a straight one together, and nothing folds.
bool should_flip(const EdgeMesh& mesh, std::uint32_t h) {
    const std::uint32_t g = mesh.twins[h];
    const Vec3 &a = mesh.places[mesh.from(h)], &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)], &d = mesh.places[mesh.tip(g)];
    if (!(cotangent(a, b, c) + cotangent(a, b, d) < -1e-6)) {
        const bool flat = shape_of(a, b, c) < 1e-9 || shape_of(a, b, d) < 1e-9;
        if (!flat) return false;
    }
    FoldGuard guard;
    guard.add(a, b, c);
    guard.add(b, a, d);
    guard.least = 0.7;
    if (!guard.admits(d, c, a) || !guard.admits(c, d, b)) return false;
    const double before = std::min(shape_of(a, b, c), shape_of(b, a, d)), after = std::min(shape_of(d, c, a), shape_of(c, d, b));
    return after > before && can_flip(mesh, h);
}

/// Whether a vertex may be moved: its triangles keep facing, and the worst of them does not become worse than it should be.
bool move_keeps_shape(const WorkSurface& work, std::uint32_t v, const Vec3& place, bool improves) {
    const EdgeMesh& mesh = work.mesh;
    FoldGuard guard;
    double before = 1, after = 1;
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        const Vec3 &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)];
        guard.add(mesh.places[v], b, c);
        before = std::min(before, shape_of(mesh.places[v], b, c));
    });
    bool keeps = true;
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        const Vec3 &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)];
        keeps = keeps && guard.admits(place, b, c);
        after = std::min(after, shape_of(place, b, c));
    });
    return keeps && (improves ? after > before : after > std::min(before, 0.5) * 0.999);
}

/// The middle of the triangles around a vertex by their areas, those with small sizes counting more, kept in the plane of the vertex.
Vec3 middle_place(const WorkSurface& work, std::uint32_t v) {
    const EdgeMesh& mesh = work.mesh;
    const Vec3& at = mesh.places[v];
    Vec3 sum{}, normal{};
    double weights = 0;
    visit_leaving(mesh, v, [&](std::uint32_t h) {
        const std::uint32_t b = mesh.to(h), c = mesh.tip(h);
        const Vec3 u = minus(mesh.places[b], at), w = minus(mesh.places[c], at), n = cross(u, w);
        const double size = work.sizes[v] + work.sizes[b] + work.sizes[c];
        const double weight = std::sqrt(dot(n, n)) / (size * size);
        sum = plus(sum, times(weight / 3, plus(u, w)));
        weights += weight;
        normal = plus(normal, n);
    });
    if (!(weights > 0)) return at;
    Vec3 step = times(1 / weights, sum);
    const double square = dot(normal, normal);
    if (square > 0) step = minus(step, times(dot(step, normal) / square, normal));
    return plus(at, step);
}

/// Whether no other edge of the triangles on both sides is longer: splitting others beside a long border would never end.
bool is_longest(const EdgeMesh& mesh, std::uint32_t h) {
    const double square = square_length(mesh, h);
    for (const std::uint32_t side : {h, mesh.twins[h]}) {
        if (square_length(mesh, next_of(side)) > square || square_length(mesh, previous_of(side)) > square) return false;
    }
    return true;
}

}  // namespace

bool try_move(WorkSurface& work, std::uint32_t v, const Vec3& to, bool improves) {
    const SurfacePoint at = closest_point(*work.reference, to, work.triangles[v]);
    if (!move_keeps_shape(work, v, at.place, improves)) return false;
    put_at(work, v, at);
    return true;
}

bool split_at_middle(WorkSurface& work, std::uint32_t h) {
    const EdgeMesh& mesh = work.mesh;
    const std::uint32_t g = mesh.twins[h], from = mesh.from(h);
    const Vec3 &a = mesh.places[from], &b = mesh.places[mesh.to(h)], &c = mesh.places[mesh.tip(h)], &d = mesh.places[mesh.tip(g)];
    const Vec3 middle = plus(a, times(0.5, minus(b, a)));
    const double length = std::sqrt(square_length(mesh, h));
    SurfacePoint at = closest_point(*work.reference, middle, work.triangles[from]);
    if (at.distance > 0.3 * length) at = closest_point_around(*work.reference, middle, work.triangles[from], length / 2);
    if (at.distance > 0.3 * length) return false;  // the surface is not near: nothing would become shorter
    FoldGuard guard;
    guard.add(a, b, c);
    guard.add(b, a, d);
    const Vec3& p = at.place;
    const bool folds = !guard.admits(a, p, c) || !guard.admits(p, b, c) || !guard.admits(b, p, d) || !guard.admits(p, a, d);
    add_on_edge(work, h, folds ? middle : p, at, VertexKind::inner);
    return true;
}

std::size_t split_long_edges(WorkSurface& work) {
    std::size_t count = 0;
    for (std::uint32_t h = 0; h < work.mesh.corners.size() && !work.stopped_at(h); ++h) {
        while (work.mesh.corners[h] != no_index && work.mesh.twins[h] != no_index && work.mesh.triangle_count() < work.most_triangles) {
            const double most = too_long * wanted(work, h);
            if (!(square_length(work.mesh, h) > most * most) || !is_longest(work.mesh, h) || !split_at_middle(work, h)) break;
            ++count;
        }
    }
    return count;
}

std::size_t collapse_short_edges(WorkSurface& work) {
    std::size_t count = 0;
    for (std::uint32_t h = 0; h < work.mesh.corners.size() && !work.stopped_at(h); ++h) {
        if (!stands_for_edge(work.mesh, h) || work.mesh.twins[h] == no_index) continue;
        const double least = too_short * wanted(work, h);
        if (!(square_length(work.mesh, h) < least * least)) continue;
        for (const std::uint32_t gone : {work.mesh.from(h), work.mesh.to(h)}) {
            if (work.kinds[gone] != VertexKind::inner || !try_collapse(work, h, gone, false)) continue;
            ++count;
            break;
        }
    }
    return count;
}

std::size_t remove_old_vertices(WorkSurface& work) {
    std::size_t count = 0, before = 0;
    do {
        before = count;
        for (std::uint32_t v = 0; v < work.kinds.size() && !work.stopped_at(v); ++v) {
            if (work.kinds[v] == VertexKind::old && work.mesh.has_vertex(v) && remove_old(work, v)) ++count;
        }
    } while (count > before);
    return count;
}

std::size_t flip_edges(WorkSurface& work) {
    // In strips of slivers a turn may travel far: what is left then is for the next pass.
    constexpr std::size_t most_turns = 4;  // for each half edge
    const std::size_t most = most_turns * work.mesh.corners.size();
    std::size_t count = 0;
    std::vector<std::uint32_t> next;  // edges around one that was turned are looked at again; each turn makes the worse triangle better
    for (std::uint32_t first = 0; first < work.mesh.corners.size() && !work.stopped_at(first); ++first) {
        if (!stands_for_edge(work.mesh, first)) continue;
        next.push_back(first);
        while (!next.empty()) {
            const std::uint32_t h = next.back();
            next.pop_back();
            if (work.mesh.twins[h] == no_index || !should_flip(work.mesh, h)) continue;
            flip_edge(work.mesh, h);
            if (++count > most || work.stopped_at(static_cast<std::uint32_t>(count))) return count;
            const std::uint32_t back = work.mesh.twins[h];
            for (const std::uint32_t side : {h, back}) {
                next.push_back(next_of(side));
                next.push_back(previous_of(side));
            }
        }
    }
    return count;
}

std::size_t move_vertices(WorkSurface& work) {
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < work.kinds.size() && !work.stopped_at(v); ++v) {
        if (work.kinds[v] != VertexKind::inner || !work.mesh.has_vertex(v)) continue;
        if (try_move(work, v, middle_place(work, v), false)) ++count;
    }
    return count;
}

void even_out(WorkSurface& work, const IsotropicRules& rules) {
    remove_old_vertices(work);
    for (int again = 0; again < 20 && flip_edges(work) > 0; ++again) {
    }  // fans from one corner to all of a line go
    collapse_short_edges(work);
    for (unsigned round = 0; round < rules.rounds && !work.stopped(); ++round) {
        remove_old_vertices(work);
        for (int again = 0; again < 12 && split_long_edges(work) > 0; ++again) flip_edges(work);
        collapse_short_edges(work);
        remove_old_vertices(work);
        flip_edges(work);
        move_vertices(work);
        flip_edges(work);
    }
}

void remesh_isotropic(WorkSurface& work, const IsotropicRules& rules) {
    even_out(work, rules);
    polish_triangles(work, rules.polished_below);
}

}  // namespace geomend::remeshing
