// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>

#include "base/disjoint_sets.h"
#include "formats/ringmesh/archive.h"
#include "model/attribute_operations.h"

namespace geomend::ringmesh {

namespace {

/// The segments of the lines that a surface names twice, ascending: it lies on both of their sides.
std::vector<Segment> cuts_of(const EntityText::Entity& surface, const std::vector<std::optional<GeogramMesh>>& lines) {
    std::vector<std::uint32_t> named;
    for (const EntityText::Bound& b : surface.bounds) named.push_back(b.number);
    std::ranges::sort(named);
    std::vector<Segment> cuts;
    for (std::size_t i = 1; i < named.size(); ++i) {
        if (named[i] != named[i - 1] || (i > 1 && named[i] == named[i - 2])) continue;
        const GeogramMesh& line = *lines[named[i]];
        for (const auto& e : line.edges) cuts.push_back(segment(line.points[e[0]], line.points[e[1]]));
    }
    std::ranges::sort(cuts);
    return cuts;
}

class Cutter {
public:
    Cutter(GeogramMesh& mesh, const std::vector<Segment>& cuts) : mesh_(mesh), cuts_(cuts), joined_(mesh.facets.corners.size()) {}

    void run() {
        join_across_edges();
        const std::size_t before = mesh_.points.size();
        std::vector<std::uint32_t> rows(before);
        for (std::uint32_t i = 0; i < before; ++i) rows[i] = i;
        give_nodes(rows);
        if (mesh_.points.size() == before) return;
        for (Attribute& a : mesh_.attributes) {
            if (a.location == AttributeLocation::point) a = taken(a, rows);
        }
    }

private:
    GeogramMesh& mesh_;
    const std::vector<Segment>& cuts_;
    DisjointSets joined_;  ///< of corners of facets
    std::vector<bool> on_cut_;

    /// Facets that share an edge share its nodes, but where a cut runs.
    void join_across_edges() {
        std::map<std::array<std::uint32_t, 2>, std::array<std::size_t, 2>> seen;  // the corners at the low and the high node
        on_cut_.assign(mesh_.points.size(), false);
        for (std::size_t f = 0; f < mesh_.facets.size(); ++f) {
            const auto corners = mesh_.facets[f];
            const std::size_t first = mesh_.facets.first_corner(f);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const std::size_t next = (k + 1) % corners.size();
                std::size_t a = first + k, b = first + next;
                if (corners[k] > corners[next]) std::swap(a, b);
                const std::array<std::uint32_t, 2> edge{std::min(corners[k], corners[next]), std::max(corners[k], corners[next])};
                if (std::ranges::binary_search(cuts_, segment(mesh_.points[edge[0]], mesh_.points[edge[1]]))) {
                    on_cut_[edge[0]] = on_cut_[edge[1]] = true;
                    continue;
                }
                const auto [at, is_new] = seen.try_emplace(edge, std::array{a, b});
                if (is_new) continue;
                joined_.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(at->second[0]));
                joined_.join(static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(at->second[1]));
            }
        }
    }

    /// The first fan of facets around a node keeps it; each other one gets its own.
    void give_nodes(std::vector<std::uint32_t>& rows) {
        std::map<std::array<std::uint32_t, 2>, std::uint32_t> node_of;  // node before and fan
        std::vector<bool> kept(mesh_.points.size(), false);
        for (std::size_t c = 0; c < mesh_.facets.corners.size(); ++c) {
            std::uint32_t& node = mesh_.facets.corners[c];
            if (!on_cut_[node]) continue;
            const auto [at, is_new] = node_of.try_emplace({node, joined_.root(static_cast<std::uint32_t>(c))}, node);
            if (is_new && kept[node]) {
                at->second = static_cast<std::uint32_t>(mesh_.points.size());
                mesh_.points.push_back(Vec3(mesh_.points[node]));
                rows.push_back(node);
            }
            kept[node] = true;
            node = at->second;
        }
    }
};

}  // namespace

void cut_surfaces(GmArchive& archive) {
    auto& meshes = archive.meshes[EntityText::surface];
    for (std::size_t s = 0; s < meshes.size(); ++s) {
        const std::vector<Segment> cuts = cuts_of(archive.text.entities[EntityText::surface][s], archive.meshes[EntityText::line]);
        if (!cuts.empty()) Cutter(*meshes[s], cuts).run();
    }
}

}  // namespace geomend::ringmesh
