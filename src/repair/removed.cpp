// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/removed.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/disjoint_sets.h"
#include "repair/surface_model.h"
#include "topology/weld.h"

namespace geomend::repair {

namespace {

struct RemovalText {
    std::string_view word, reason;
};
constexpr std::array<RemovalText, 9> texts = {{{"no-area", "it has no area"},
                                               {"double", "its surface has the same triangle twice"},
                                               {"stray", "it is no wider than ten tolerances, beside larger parts of its surface"},
                                               {"overlap", "it lies in another surface, which stays"},
                                               {"tail", "it sticks through another surface by less than the limit"},
                                               {"outside", "it sticks out of the closed outer boundary"},
                                               {"edited", "an edit takes it out"},
                                               {"beyond", "it reaches beyond what its surface ends on after an edit"},
                                               {"micro", "it bounds a region smaller than the limit"}}};

// Of a step, a reason and a patch.
using Group = std::tuple<std::string_view, Removal, std::uint32_t>;
Group group_of(const RemovedTriangle& t) { return {t.step, t.why, t.patch}; }

struct GroupEdge {
    Group group;
    std::uint32_t low, high, triangle;
    auto key() const { return std::tie(group, low, high); }
};

// Per triangle the first one of its piece.
std::vector<std::uint32_t> pieces_by_edges(std::span<const RemovedTriangle> removed, const std::vector<Triangle>& corners) {
    std::vector<GroupEdge> edges;
    edges.reserve(3 * removed.size());
    for (std::uint32_t t = 0; t < removed.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(corners[t][k], corners[t][(k + 1) % 3]);
            edges.push_back({group_of(removed[t]), low, high, t});
        }
    }
    std::ranges::sort(
        edges, [](const GroupEdge& a, const GroupEdge& b) { return std::tuple(a.key(), a.triangle) < std::tuple(b.key(), b.triangle); });
    DisjointSets sets(removed.size());
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (edges[i].key() == edges[i - 1].key()) sets.join(edges[i].triangle, edges[i - 1].triangle);
    }
    std::vector<std::uint32_t> first(removed.size(), no_index), piece(removed.size());
    for (std::uint32_t t = 0; t < removed.size(); ++t) {
        std::uint32_t& of_root = first[sets.root(t)];
        if (of_root == no_index) of_root = t;
        piece[t] = of_root;
    }
    return piece;
}

}  // namespace

std::string_view word_of(Removal why) { return texts[static_cast<std::size_t>(why)].word; }
std::string_view reason_of(Removal why) { return texts[static_cast<std::size_t>(why)].reason; }

bool is_added(const SurfaceModel& model, std::uint32_t triangle) {
    return model.origin.triangles[triangle] == no_index || (!model.added.empty() && model.added[triangle] != 0);
}

void mark_added(SurfaceModel& model, std::uint32_t first_triangle) {
    model.added.resize(model.model.soup.triangles.size(), 0);
    std::fill(model.added.begin() + first_triangle, model.added.end(), std::uint8_t{1});
}

void note_removed(SurfaceModel& model, std::span<const std::uint32_t> triangles, Removal why) {
    const TriangleSoup& soup = model.model.soup;
    for (const std::uint32_t t : triangles) {
        if (is_added(model, t)) continue;
        const auto& [a, b, c] = soup.triangles[t];
        model.removed.push_back({{soup.vertices[a], soup.vertices[b], soup.vertices[c]}, soup.patches[t], why, {}});
    }
}

void note_removed(SurfaceModel& model, std::span<const std::uint8_t> keep, std::vector<std::uint8_t>& noted, Removal why) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < keep.size(); ++t) {
        if (keep[t] == 0 && noted[t] != 0) triangles.push_back(t);
    }
    note_removed(model, triangles, why);
    noted.assign(keep.begin(), keep.end());
}

std::vector<RemovedPiece> removed_pieces(std::span<const RemovedTriangle> removed) {
    topology::Welder welder(3 * removed.size());
    std::vector<Triangle> corners;
    for (const RemovedTriangle& t : removed)
        corners.push_back({welder.add(t.corners[0]), welder.add(t.corners[1]), welder.add(t.corners[2])});
    const auto first = pieces_by_edges(removed, corners);
    std::vector<RemovedPiece> pieces;
    std::vector<std::uint32_t> number(removed.size(), no_index);
    std::vector<std::map<std::uint32_t, std::uint32_t>> points;  // per piece: welded vertex -> its own
    for (std::uint32_t t = 0; t < removed.size(); ++t) {
        std::uint32_t& n = number[first[t]];
        if (n == no_index) {
            n = static_cast<std::uint32_t>(pieces.size());
            pieces.push_back({removed[t].step, removed[t].why, removed[t].patch, {}, {}});
            points.emplace_back();
        }
        Triangle own{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [at, is_new] = points[n].try_emplace(corners[t][k], static_cast<std::uint32_t>(pieces[n].points.size()));
            if (is_new) pieces[n].points.push_back(removed[t].corners[k]);
            own[k] = at->second;
        }
        pieces[n].triangles.push_back(own);
    }
    return pieces;
}

}  // namespace geomend::repair
