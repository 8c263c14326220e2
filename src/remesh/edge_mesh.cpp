// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/edge_mesh.h"

#include <algorithm>

namespace geomend::remeshing {

namespace {

void join(EdgeMesh& mesh, std::uint32_t a, std::uint32_t b) {
    if (a != no_index) mesh.twins[a] = b;
    if (b != no_index) mesh.twins[b] = a;
}

/// Makes a half-edge that leaves a vertex its first one: turns back until the border, if there is one.
void set_leaving(EdgeMesh& mesh, std::uint32_t h) {
    const std::uint32_t first = h;
    while (mesh.twins[h] != no_index) {
        h = next_of(mesh.twins[h]);
        if (h == first) break;
    }
    mesh.leaving[mesh.from(h)] = h;
}

std::uint32_t new_triangle(EdgeMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint32_t t = 0;
    if (!mesh.free_triangles.empty()) {
        t = mesh.free_triangles.back();
        mesh.free_triangles.pop_back();
    } else {
        t = mesh.triangle_count();
        mesh.corners.resize(mesh.corners.size() + 3);
        mesh.twins.resize(mesh.twins.size() + 3, no_index);
    }
    mesh.corners[3 * std::size_t{t}] = a;
    mesh.corners[3 * std::size_t{t} + 1] = b;
    mesh.corners[3 * std::size_t{t} + 2] = c;
    return t;
}

std::uint32_t new_vertex(EdgeMesh& mesh, const Vec3& place) {
    if (!mesh.free_vertices.empty()) {
        const std::uint32_t v = mesh.free_vertices.back();
        mesh.free_vertices.pop_back();
        mesh.places[v] = place;
        return v;
    }
    mesh.places.push_back(place);
    mesh.leaving.push_back(no_index);
    return static_cast<std::uint32_t>(mesh.places.size() - 1);
}

void remove_triangle(EdgeMesh& mesh, std::uint32_t h) {
    const std::uint32_t t = h / 3;
    for (std::size_t k = 0; k < 3; ++k) {
        mesh.corners[3 * std::size_t{t} + k] = no_index;
        mesh.twins[3 * std::size_t{t} + k] = no_index;
    }
    mesh.free_triangles.push_back(t);
}

/// Splits the triangle of a half-edge at a vertex on it; the old one keeps the first part. \return the half-edge of the second part
std::uint32_t split_triangle(EdgeMesh& mesh, std::uint32_t h, std::uint32_t v) {
    const std::uint32_t onward = next_of(h);
    const std::uint32_t b = mesh.to(h), beyond = mesh.twins[onward];
    const std::uint32_t t = new_triangle(mesh, v, b, mesh.tip(h));
    mesh.corners[onward] = v;
    join(mesh, 3 * t + 1, beyond);
    join(mesh, onward, 3 * t + 2);
    if (mesh.leaving[b] == onward) mesh.leaving[b] = 3 * t + 1;
    return 3 * t;
}

/// The half-edges that leave a vertex, one after the other.
struct Fan {
    const EdgeMesh& mesh;
    std::uint32_t first, at;
    Fan(const EdgeMesh& m, std::uint32_t v) : mesh(m), first(m.leaving[v]), at(first) {}

    bool leads_to(std::uint32_t v) const { return mesh.to(at) == v || mesh.tip(at) == v; }
    /// \return false at the end
    bool next() {
        at = mesh.twins[previous_of(at)];
        return at != no_index && at != first;
    }
};

/// Whether there is an edge between two vertices. Cost: as many steps as the one with fewer edges has.
bool are_neighbours(const EdgeMesh& mesh, std::uint32_t a, std::uint32_t b) {
    Fan of_a(mesh, a), of_b(mesh, b);
    for (;;) {
        if (of_a.leads_to(b) || of_b.leads_to(a)) return true;
        if (!of_a.next() || !of_b.next()) return false;
    }
}

unsigned valence(const EdgeMesh& mesh, std::uint32_t v) {
    unsigned n = 0;
    visit_neighbours(mesh, v, [&](std::uint32_t) { ++n; });
    return n;
}

/// The triangles of a half-edge's side of a collapse: they go, and what lies across their other edges becomes neighbours.
void fold_side(EdgeMesh& mesh, std::uint32_t h) {
    const std::uint32_t a = mesh.twins[next_of(h)], b = mesh.twins[previous_of(h)], tip = mesh.tip(h);
    if (mesh.leaving[tip] == previous_of(h)) mesh.leaving[tip] = a;
    if (a != no_index) mesh.twins[a] = b;
    if (b != no_index) mesh.twins[b] = a;
    remove_triangle(mesh, h);
}

}  // namespace

Result<FannedMesh> fanned_mesh(std::span<const Vec3> places, std::span<const std::uint32_t> corners,
                               std::span<const std::uint32_t> neighbours) {
    const auto refuse = [](const char* why) { return failure(FailureKind::cannot_hold, "F026", {}, why); };
    FannedMesh made;
    EdgeMesh& mesh = made.mesh;
    mesh.corners.assign(corners.size(), no_index);
    mesh.twins.assign(corners.size(), no_index);
    const auto start = [&](std::uint32_t h) { return corners[h]; };
    for (std::uint32_t h = 0; h < corners.size(); ++h) {
        if (start(h) == start(next_of(h))) return refuse("a triangle names a vertex twice");
        const std::uint32_t t = neighbours[h];
        if (t == no_index) continue;
        for (std::uint32_t g = 3 * t; g < 3 * t + 3; ++g) {
            if (neighbours[g] == h / 3 && start(g) == start(next_of(h)) && start(next_of(g)) == start(h)) mesh.twins[h] = g;
        }
        if (mesh.twins[h] == no_index) return refuse("neighbouring triangles turn opposite ways");
    }
    for (std::uint32_t h = 0; h < corners.size(); ++h) {
        if (mesh.corners[h] != no_index) continue;
        const auto v = static_cast<std::uint32_t>(mesh.places.size());
        mesh.places.push_back(places[start(h)]);
        made.vertex_of.push_back(start(h));
        std::uint32_t first = h;
        while (mesh.twins[first] != no_index) {
            first = next_of(mesh.twins[first]);
            if (first == h) break;
        }
        mesh.leaving.push_back(first);
        std::uint32_t g = first;
        do {
            mesh.corners[g] = v;
            g = mesh.twins[previous_of(g)];
        } while (g != no_index && g != first);
    }
    return made;
}

std::uint32_t split_edge(EdgeMesh& mesh, std::uint32_t h, const Vec3& place) {
    const std::uint32_t back = mesh.twins[h];
    const std::uint32_t v = new_vertex(mesh, place);
    const std::uint32_t second = split_triangle(mesh, h, v);
    mesh.twins[second] = no_index;
    if (back != no_index) {
        const std::uint32_t back_second = split_triangle(mesh, back, v);
        join(mesh, h, back_second);
        join(mesh, second, back);
    }
    mesh.leaving[v] = second;
    return v;
}

std::uint32_t split_face(EdgeMesh& mesh, std::uint32_t triangle, const Vec3& place) {
    const std::uint32_t h = 3 * triangle;
    const std::uint32_t a = mesh.corners[h], b = mesh.corners[h + 1], c = mesh.corners[h + 2];
    const std::uint32_t beyond_bc = mesh.twins[h + 1], beyond_ca = mesh.twins[h + 2];
    const std::uint32_t v = new_vertex(mesh, place);
    const std::uint32_t second = 3 * new_triangle(mesh, b, c, v), third = 3 * new_triangle(mesh, c, a, v);
    mesh.corners[h + 2] = v;
    join(mesh, second, beyond_bc);
    join(mesh, third, beyond_ca);
    join(mesh, h + 1, second + 2);
    join(mesh, second + 1, third + 2);
    join(mesh, third + 1, h + 2);
    if (mesh.leaving[b] == h + 1) mesh.leaving[b] = second;
    if (mesh.leaving[c] == h + 2) mesh.leaving[c] = third;
    mesh.leaving[v] = h + 2;
    return v;
}

bool can_flip(const EdgeMesh& mesh, std::uint32_t h) {
    const std::uint32_t back = mesh.twins[h];
    if (back == no_index) return false;
    const std::uint32_t c = mesh.tip(h), d = mesh.tip(back);
    return c != d && !are_neighbours(mesh, c, d);
}

void flip_edge(EdgeMesh& mesh, std::uint32_t h) {
    // a -> b with tips c and d becomes d -> c: the triangle of h is (d, c, a) then, that of its twin (c, d, b)
    const std::uint32_t g = mesh.twins[h];
    const std::uint32_t hn = next_of(h), hp = previous_of(h), gn = next_of(g), gp = previous_of(g);
    const std::uint32_t a = mesh.from(h), b = mesh.from(g), c = mesh.from(hp), d = mesh.from(gp);
    const std::uint32_t bc = mesh.twins[hn], ca = mesh.twins[hp], ad = mesh.twins[gn], db = mesh.twins[gp];
    mesh.corners[h] = d;
    mesh.corners[hn] = c;
    mesh.corners[hp] = a;
    mesh.corners[g] = c;
    mesh.corners[gn] = d;
    mesh.corners[gp] = b;
    mesh.twins[hn] = ca;
    if (ca != no_index) mesh.twins[ca] = hn;
    mesh.twins[hp] = ad;
    if (ad != no_index) mesh.twins[ad] = hp;
    mesh.twins[gn] = db;
    if (db != no_index) mesh.twins[db] = gn;
    mesh.twins[gp] = bc;
    if (bc != no_index) mesh.twins[bc] = gp;
    if (mesh.leaving[a] == h || mesh.leaving[a] == gn) mesh.leaving[a] = hp;
    if (mesh.leaving[b] == g || mesh.leaving[b] == hn) mesh.leaving[b] = gp;
    if (mesh.leaving[c] == hp) mesh.leaving[c] = hn;
    if (mesh.leaving[d] == gp) mesh.leaving[d] = gn;
}

bool can_collapse(const EdgeMesh& mesh, std::uint32_t h, std::uint32_t gone) {
    const std::uint32_t back = mesh.twins[h], stays = mesh.from(h) == gone ? mesh.to(h) : mesh.from(h);
    const bool border_edge = back == no_index;
    if (mesh.on_border(gone) && !border_edge) return false;  // it would leave the border, or pinch it
    const std::uint32_t c = mesh.tip(h), d = border_edge ? no_index : mesh.tip(back);
    if (c == d) return false;
    unsigned common = 0;
    bool only_tips = true;
    visit_neighbours(mesh, gone, [&](std::uint32_t v) {
        if (v == stays || !are_neighbours(mesh, stays, v)) return;
        ++common;
        only_tips = only_tips && (v == c || v == d);
    });
    if (!only_tips || common != (border_edge ? 1u : 2u)) return false;
    const auto side_stays = [&](std::uint32_t g) {
        if (mesh.twins[next_of(g)] == no_index && mesh.twins[previous_of(g)] == no_index) return false;
        return mesh.on_border(mesh.tip(g)) || valence(mesh, mesh.tip(g)) > 3;
    };
    return side_stays(h) && (border_edge || side_stays(back));
}

void collapse_edge(EdgeMesh& mesh, std::uint32_t h, std::uint32_t gone) {
    const std::uint32_t back = mesh.twins[h], stays = mesh.from(h) == gone ? mesh.to(h) : mesh.from(h);
    const auto goes = [&](std::uint32_t g) { return g / 3 == h / 3 || (back != no_index && g / 3 == back / 3); };
    std::uint32_t leaves = no_index;  // that which stays, afterwards
    visit_leaving(mesh, gone, [&](std::uint32_t g) {
        mesh.corners[g] = stays;
        if (!goes(g)) leaves = g;
    });
    if (leaves == no_index) {  // it had the one triangle of a border edge
        const std::uint32_t onward = mesh.twins[next_of(h)];
        leaves = onward != no_index ? next_of(onward) : mesh.twins[previous_of(h)];
    }
    const bool first_goes = goes(mesh.leaving[stays]) || back == no_index;
    fold_side(mesh, h);
    if (back != no_index) fold_side(mesh, back);
    if (first_goes) set_leaving(mesh, leaves);
    mesh.leaving[gone] = no_index;
    mesh.free_vertices.push_back(gone);
}

bool is_consistent(const EdgeMesh& mesh) {
    std::vector<std::uint32_t> uses(mesh.places.size(), 0), in_fan(mesh.places.size(), 0);
    for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
        if (mesh.corners[h] == no_index) {
            if (mesh.has_triangle(h / 3)) return false;
            continue;
        }
        ++uses[mesh.from(h)];
        const std::uint32_t g = mesh.twins[h];
        if (g == no_index) continue;
        if (mesh.corners[g] == no_index || mesh.twins[g] != h || mesh.from(g) != mesh.to(h) || mesh.to(g) != mesh.from(h)) return false;
    }
    for (std::uint32_t v = 0; v < mesh.places.size(); ++v) {
        if (!mesh.has_vertex(v)) {
            if (uses[v] != 0) return false;
            continue;
        }
        if (mesh.from(mesh.leaving[v]) != v) return false;
        visit_leaving(mesh, v, [&](std::uint32_t) { ++in_fan[v]; });
        if (in_fan[v] != uses[v]) return false;
    }
    return true;
}

}  // namespace geomend::remeshing
