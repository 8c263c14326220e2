// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/soup_edges.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "model/objects.h"

namespace geomend::repair {

SoupEdges edges_of(const TriangleSoup& soup, std::span<const std::uint8_t> keep) {
    SoupEdges edges;
    edges.uses.reserve(3 * soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const Triangle& tri = soup.triangles[t];
        if ((!keep.empty() && keep[t] == 0) || tri[0] == tri[1] || tri[1] == tri[2] || tri[2] == tri[0]) continue;
        for (std::uint8_t k = 0; k < 3; ++k) {
            const std::uint32_t a = tri[k], b = tri[(k + 1) % 3];
            edges.uses.push_back({std::min(a, b), std::max(a, b), t, k});
        }
    }
    std::ranges::sort(edges.uses, [](const SoupEdges::Use& a, const SoupEdges::Use& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
    for (std::uint32_t i = 0; i < edges.uses.size(); ++i) {
        const bool begins = i == 0 || edges.uses[i].low != edges.uses[i - 1].low || edges.uses[i].high != edges.uses[i - 1].high;
        if (begins) edges.first.push_back(i);
    }
    edges.first.push_back(static_cast<std::uint32_t>(edges.uses.size()));
    return edges;
}

bool is_inner(const TriangleSoup& soup, std::span<const SoupEdges::Use> uses) {
    return uses.size() == 2 && soup.patches[uses[0].triangle] == soup.patches[uses[1].triangle];
}

PatchPieces pieces_between_lines(const TriangleSoup& soup, const SoupEdges& edges) {
    DisjointSets sets(soup.triangles.size());
    std::vector<std::uint8_t> looked_at(soup.triangles.size(), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        for (const auto& use : uses) looked_at[use.triangle] = 1;
        if (is_inner(soup, uses)) sets.join(uses[0].triangle, uses[1].triangle);
    }
    PatchPieces pieces;
    pieces.of.assign(soup.triangles.size(), no_index);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (looked_at[t] == 0) continue;
        const std::uint32_t root = sets.root(t);
        if (root == t) {  // the smallest of its set, so it comes first
            pieces.of[t] = static_cast<std::uint32_t>(pieces.patch.size());
            pieces.patch.push_back(soup.patches[t]);
        } else {
            pieces.of[t] = pieces.of[root];
        }
    }
    return pieces;
}

}  // namespace geomend::repair
