// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/soup_edit.h"

#include <algorithm>

#include "base/disjoint_sets.h"

namespace geomend::repair {

namespace {

struct PatchEdge {
    std::uint32_t patch, low, high, triangle;
    bool same_edge(const PatchEdge& e) const { return patch == e.patch && low == e.low && high == e.high; }
};

std::vector<PatchEdge> patch_edges(const TriangleSoup& soup, std::span<const std::uint8_t> keep) {
    std::vector<PatchEdge> edges;
    edges.reserve(3 * soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (keep[t] == 0) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = soup.triangles[t][k], b = soup.triangles[t][(k + 1) % 3];
            edges.push_back({soup.patches[t], std::min(a, b), std::max(a, b), t});
        }
    }
    std::ranges::sort(edges, [](const PatchEdge& a, const PatchEdge& b) {
        if (a.patch != b.patch) return a.patch < b.patch;
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
    return edges;
}

}  // namespace

Parts parts_of(const TriangleSoup& soup, std::span<const std::uint8_t> keep) {
    DisjointSets sets(soup.triangles.size());
    const auto edges = patch_edges(soup, keep);
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (edges[i].same_edge(edges[i - 1])) sets.join(edges[i - 1].triangle, edges[i].triangle);
    }
    Parts parts{std::vector<std::uint32_t>(soup.triangles.size(), no_index), 0};
    std::vector<std::uint32_t> number(soup.triangles.size(), no_index);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (keep[t] == 0) continue;
        const std::uint32_t root = sets.root(t);
        if (number[root] == no_index) number[root] = parts.count++;
        parts.of[t] = number[root];
    }
    return parts;
}

void keep_triangles(SurfaceModel& model, std::span<const std::uint8_t> keep) {
    const TriangleSoup& soup = model.model.soup;
    TriangleSoup kept;
    Origin origin;
    std::vector<std::uint8_t> used(soup.vertices.size(), 0);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (keep[t] == 0) continue;
        for (const std::uint32_t v : soup.triangles[t]) used[v] = 1;
    }
    for (const auto& edge : soup.edges) used[edge[0]] = used[edge[1]] = 1;
    std::vector<std::uint32_t> number(soup.vertices.size(), no_index);
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (used[v] == 0) continue;
        number[v] = static_cast<std::uint32_t>(kept.vertices.size());
        kept.vertices.push_back(soup.vertices[v]);
        origin.vertices.push_back(Origin::from_vertex(v));
    }
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (keep[t] == 0) continue;
        const auto& [a, b, c] = soup.triangles[t];
        kept.triangles.push_back({number[a], number[b], number[c]});
        kept.patches.push_back(soup.patches[t]);
        origin.triangles.push_back(t);
    }
    for (const auto& edge : soup.edges) kept.edges.push_back({number[edge[0]], number[edge[1]]});
    kept.edge_ids = soup.edge_ids;
    take_soup(model, std::move(kept), origin);
}

}  // namespace geomend::repair
