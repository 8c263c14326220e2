// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/scars.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string_view>

#include "base/disjoint_sets.h"
#include "base/vectors.h"
#include "editing/lip_pairs.h"
#include "editing/soup_mesh.h"
#include "editing/trace.h"
#include "repair/soup_edges.h"

namespace geomend::repair {

namespace {

/// The angles at which triangles stand around an edge, from the first of them.
std::vector<double> angles_around(const TriangleSoup& soup, std::span<const SoupEdges::Use> uses) {
    const Vec3 base = soup.vertices[uses[0].low], along = minus(soup.vertices[uses[0].high], base);
    std::vector<Vec3> into;
    for (const auto& use : uses)
        into.push_back(across(minus(soup.vertices[soup.triangles[use.triangle][(use.corner + 2u) % 3]], base), along));
    const Vec3 beside = cross(along, into[0]);
    const double scale = std::sqrt(dot(along, along));
    std::vector<double> angles;
    for (const Vec3& u : into) angles.push_back(std::atan2(dot(u, beside) / scale, dot(u, into[0])));
    return angles;
}

bool are_of_one_interface(const SurfaceModel& model, std::span<const SoupEdges::Use> uses) {
    const auto& patches = model.model.patches;
    const std::string& name = patches[model.model.soup.patches[uses[0].triangle]].interface_name;
    return std::ranges::all_of(uses,
                               [&](const auto& use) { return patches[model.model.soup.patches[use.triangle]].interface_name == name; });
}

/// Whether the file gives the two sides of an edge inside of a patch nodes of their own: it is a slit there.
bool is_slit(const SurfaceModel& model, std::span<const SoupEdges::Use> uses) {
    std::array<std::uint32_t, 2> from{model.origin.triangles[uses[0].triangle], model.origin.triangles[uses[1].triangle]};
    if (from[0] == no_index || from[1] == no_index || model.source.patches[from[0]] != model.source.patches[from[1]]) return false;
    const auto node_at = [&](std::uint32_t t, const Vec3& place) {
        for (const std::uint32_t v : model.source.triangles[t]) {
            if (model.source.vertices[v] == place) return v;
        }
        return no_index;
    };
    return std::ranges::any_of(std::array{uses[0].low, uses[0].high}, [&](std::uint32_t end) {
        const Vec3& place = model.model.soup.vertices[end];
        const std::uint32_t a = node_at(from[0], place), b = node_at(from[1], place);
        return a != no_index && b != no_index && a != b;
    });
}

std::set<std::array<std::uint32_t, 2>> embedded_edges(const TriangleSoup& soup) {
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const auto& [a, b] : soup.edges) edges.insert({std::min(a, b), std::max(a, b)});
    return edges;
}

/// Per patch the first patch of its interface.
std::vector<std::uint32_t> interfaces_of(const SurfaceModel& model) {
    std::map<std::string_view, std::uint32_t> first;
    std::vector<std::uint32_t> of;
    for (std::uint32_t p = 0; p < model.model.patches.size(); ++p)
        of.push_back(first.emplace(model.model.patches[p].interface_name, p).first->second);
    return of;
}

void join_patches(SurfaceModel& model, DisjointSets& sets, ScarCounts& counts) {
    auto& became = model.became;
    if (became.empty()) {
        became.resize(model.model.patches.size());
        std::iota(became.begin(), became.end(), 0u);
    }
    for (std::uint32_t p = static_cast<std::uint32_t>(became.size()); p < model.model.patches.size(); ++p) became.push_back(p);
    for (std::uint32_t& p : became) {
        if (p == no_index || sets.root(p) == p) continue;
        p = sets.root(p);
    }
    std::vector<std::uint8_t> gone(model.model.patches.size(), 0);
    for (std::uint32_t& p : model.model.soup.patches) {
        const std::uint32_t root = sets.root(p);
        if (root == p) continue;
        gone[p] = 1;
        p = root;
    }
    counts.joined += static_cast<std::uint64_t>(std::ranges::count(gone, 1));
}

/// Notes edges between vertices of a trace of which one was erased. Those of a cut of this run were not in what was read.
void note_erased(SurfaceModel& model, std::span<const std::uint32_t> trace, std::span<const std::uint32_t> now) {
    std::vector<std::uint8_t> on_trace(now.size(), 0);
    bool any = false;
    for (const std::uint32_t v : trace) {
        on_trace[v] = model.origin.vertices[v].vertex != no_index ? 1 : 0;
        any |= on_trace[v] != 0 && now[v] == no_index;
    }
    if (!any) return;
    const TriangleSoup& soup = model.model.soup;
    const SoupEdges edges = edges_of(soup);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto& use = edges[e][0];
        const bool erased = now[use.low] == no_index || now[use.high] == no_index;
        if (erased && on_trace[use.low] != 0 && on_trace[use.high] != 0)
            model.erased_edges.push_back({soup.vertices[use.low], soup.vertices[use.high]});
    }
}

}  // namespace

std::uint32_t successor_of(const SurfaceModel& model, std::uint32_t patch) {
    return patch < model.became.size() ? model.became[patch] : patch;
}

std::vector<std::uint32_t> stitch_lips(SurfaceModel& model, const ScarRules& rules, ScarCounts& counts,
                                       const std::vector<std::array<std::uint32_t, 2>>* only) {
    const TriangleSoup& soup = model.model.soup;
    const SoupEdges edges = edges_of(soup);
    const auto embedded = embedded_edges(soup);
    DisjointSets sets(model.model.patches.size());
    std::vector<std::uint32_t> trace;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        if (uses.size() < 2 || !are_of_one_interface(model, uses)) continue;
        if (is_inner(soup, uses) && !is_slit(model, uses)) continue;
        if (only != nullptr && !std::ranges::binary_search(*only, std::array{uses[0].low, uses[0].high})) continue;
        if (embedded.contains({uses[0].low, uses[0].high})) continue;
        const auto pairs = editing::lip_pairs(angles_around(soup, uses), rules.angle * std::numbers::pi / 180);
        if (pairs.empty()) ++counts.bent;
        counts.lips += pairs.size();
        for (const auto& [a, b] : pairs) sets.join(soup.patches[uses[a].triangle], soup.patches[uses[b].triangle]);
        if (uses.size() == 2 && !pairs.empty()) trace.insert(trace.end(), {uses[0].low, uses[0].high});
    }
    join_patches(model, sets, counts);
    std::ranges::sort(trace);
    trace.erase(std::unique(trace.begin(), trace.end()), trace.end());
    return trace;
}

std::vector<std::uint32_t> erase_scars(SurfaceModel& model, std::span<const std::uint32_t> trace, bool made, const ScarRules& rules,
                                       ScarCounts& counts) {
    editing::SoupMesh mesh(model.model.soup);
    const auto surfaces = interfaces_of(model);
    const editing::TraceRules on_lines{{rules.distance, rules.flatness}, true, false, surfaces};
    auto erased = editing::erase_trace(mesh, trace, on_lines);
    if (made) {
        std::vector<std::uint32_t> own;
        for (std::uint32_t v = 0; v < model.origin.vertices.size(); ++v) {
            const auto& from = model.origin.vertices[v];
            if (from.vertex == no_index && from.triangle != no_index && !std::ranges::binary_search(trace, v)) own.push_back(v);
        }
        const auto inside = editing::erase_trace(mesh, own, {on_lines.rings, false, false, surfaces});
        erased.erased += inside.erased;
        erased.not_flat += inside.not_flat;
    }
    counts.erased += erased.erased;
    counts.needed += erased.needed;
    counts.border += erased.border;
    counts.not_flat += erased.not_flat;
    auto edited = std::move(mesh).take();
    std::vector<std::uint32_t> now(model.model.soup.vertices.size(), no_index);
    for (std::uint32_t v = 0; v < edited.origin.vertices.size(); ++v) now[edited.origin.vertices[v].vertex] = v;
    note_erased(model, trace, now);
    take_soup(model, std::move(edited.soup), edited.origin);
    return now;
}

}  // namespace geomend::repair
