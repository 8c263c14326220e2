// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/overlaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/vectors.h"
#include "repair/soup_edges.h"
#include "repair/soup_edit.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

/// Groups of triangles on the same three vertices, of more than one patch: numbers of triangles, a group after the other.
struct Coincident {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> first;     ///< per group, and the end
    std::vector<std::uint32_t> group_of;  ///< per triangle of the soup; no_index: it is in none

    std::size_t size() const { return first.size() - 1; }
};

Coincident coincident_triangles(const TriangleSoup& soup) {
    std::vector<Triangle> key(soup.triangles.size());
    std::vector<std::uint32_t> order(soup.triangles.size());
    for (std::uint32_t t = 0; t < key.size(); ++t) {
        key[t] = soup.triangles[t];
        std::ranges::sort(key[t]);
        order[t] = t;
    }
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
    Coincident found{{}, {0}, std::vector<std::uint32_t>(key.size(), no_index)};
    for (std::size_t i = 0; i < order.size();) {
        std::size_t j = i + 1;
        while (j < order.size() && key[order[j]] == key[order[i]]) ++j;
        if (j > i + 1) {
            for (std::size_t k = i; k < j; ++k) {
                found.group_of[order[k]] = static_cast<std::uint32_t>(found.first.size() - 1);
                found.triangles.push_back(order[k]);
            }
            found.first.push_back(static_cast<std::uint32_t>(found.triangles.size()));
        }
        i = j;
    }
    return found;
}

/// An edge of a triangle within its patch.
struct OwnEdge {
    std::uint32_t patch, low, high, triangle;
    auto edge() const { return std::tuple(patch, low, high); }
};

std::vector<OwnEdge> edges_by_patch(const TriangleSoup& soup) {
    std::vector<OwnEdge> edges;
    edges.reserve(3 * soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(soup.triangles[t][k], soup.triangles[t][(k + 1) % 3]);
            edges.push_back({soup.patches[t], low, high, t});
        }
    }
    std::ranges::sort(
        edges, [](const OwnEdge& a, const OwnEdge& b) { return a.edge() != b.edge() ? a.edge() < b.edge() : a.triangle < b.triangle; });
    return edges;
}

/// How much of the outline of the part that a triangle is in is held by the rest of its patch: 0 to 4 quarters.
/// \return per triangle; 0 where it is in no group
std::vector<std::uint8_t> quarters_held(const TriangleSoup& soup, const Coincident& found) {
    const auto edges = edges_by_patch(soup);
    DisjointSets parts(soup.triangles.size());
    const auto is_in = [&](std::uint32_t t) { return found.group_of[t] != no_index; };
    const auto each_edge = [&](const auto& use) {
        for (std::size_t i = 0; i < edges.size();) {
            std::size_t j = i + 1;
            while (j < edges.size() && edges[j].edge() == edges[i].edge()) ++j;
            use(std::span(edges).subspan(i, j - i));
            i = j;
        }
    };
    each_edge([&](std::span<const OwnEdge> uses) {
        for (std::size_t k = 1; k < uses.size(); ++k) {
            if (is_in(uses[0].triangle) && is_in(uses[k].triangle)) parts.join(uses[0].triangle, uses[k].triangle);
        }
    });
    std::vector<double> outline(soup.triangles.size(), 0), held(soup.triangles.size(), 0);  // by root
    each_edge([&](std::span<const OwnEdge> uses) {
        const auto inside = static_cast<std::size_t>(std::ranges::count_if(uses, [&](const auto& u) { return is_in(u.triangle); }));
        if (inside != 1) return;
        const Vec3 along = minus(soup.vertices[uses[0].high], soup.vertices[uses[0].low]);
        const double length = std::sqrt(dot(along, along));
        const std::uint32_t root = parts.root(std::ranges::find_if(uses, [&](const auto& u) { return is_in(u.triangle); })->triangle);
        outline[root] += length;
        if (uses.size() > 1) held[root] += length;
    });
    std::vector<std::uint8_t> quarters(soup.triangles.size(), 0);
    for (std::uint32_t t = 0; t < quarters.size(); ++t) {
        const std::uint32_t root = parts.root(t);
        if (is_in(t) && outline[root] > 0) quarters[t] = static_cast<std::uint8_t>(std::lround(4 * held[root] / outline[root]));
    }
    return quarters;
}

int rank_of(FeatureRole role) {
    switch (role) {
        case FeatureRole::boundary:
            return 2;
        case FeatureRole::fault:
            return 1;
        default:
            return 0;
    }
}

std::vector<double> areas_of(const TriangleSoup& soup, std::size_t patches) {
    std::vector<double> areas(patches, 0);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) areas[soup.patches[t]] += triangle_area(soup, t);
    return areas;
}

/// Says of which patches nothing is left.
void mark_gone(SurfaceModel& model, std::vector<LeftOverlap>& left_out) {
    const auto& patches = model.model.patches;
    std::vector<std::uint8_t> left(patches.size(), 0);
    for (const std::uint32_t p : model.model.soup.patches) left[p] = 1;
    model.lies_in.resize(patches.size(), no_index);
    for (LeftOverlap& o : left_out) {
        if (left[o.left_out] != 0) continue;
        o.whole = true;
        if (model.lies_in[o.left_out] != no_index) continue;
        model.lies_in[o.left_out] = o.kept;
        add_loss(model.losses, {LossClass::identity, patches[o.left_out].name, "surface",
                                "all of it lies in '" + patches[o.kept].name + "' and others that stay", 1});
    }
}

}  // namespace

std::vector<LeftOverlap> leave_out_overlaps(SurfaceModel& model) {
    const TriangleSoup& soup = model.model.soup;
    const Coincident found = coincident_triangles(soup);
    std::vector<LeftOverlap> result;
    if (found.size() == 0) return result;
    const auto quarters = quarters_held(soup, found);
    const auto areas = areas_of(soup, model.model.patches.size());
    const auto goes_before = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t p = soup.patches[a], q = soup.patches[b];
        if (quarters[a] != quarters[b]) return quarters[a] > quarters[b];
        const int rank_a = rank_of(model.model.patches[p].role), rank_b = rank_of(model.model.patches[q].role);
        if (rank_a != rank_b) return rank_a > rank_b;
        if (areas[p] != areas[q]) return areas[p] > areas[q];
        return p != q ? p < q : a < b;
    };
    std::vector<std::uint8_t> keep(soup.triangles.size(), 1);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> counts;
    for (std::size_t g = 0; g < found.size(); ++g) {
        const auto group = std::span(found.triangles).subspan(found.first[g], found.first[g + 1] - found.first[g]);
        const std::uint32_t best = *std::ranges::min_element(group, goes_before);
        for (const std::uint32_t t : group) {
            if (t == best) continue;
            keep[t] = 0;
            ++counts[{soup.patches[t], soup.patches[best]}];
        }
    }
    for (const auto& [pair, count] : counts) result.push_back({pair.second, pair.first, count, false});
    std::vector<std::uint8_t> noted(keep.size(), 1);
    note_removed(model, keep, noted, Removal::overlap);
    keep_triangles(model, keep);
    mark_gone(model, result);
    return result;
}

}  // namespace geomend::repair
