// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/tet_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/vectors.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

/// Facets with the same three corners are two sides of one.
struct FacetKey {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t number;
    auto operator<=>(const FacetKey&) const = default;
};

std::array<std::uint32_t, 3> sorted(std::array<std::uint32_t, 3> corners) {
    std::ranges::sort(corners);
    return corners;
}

void take_tets(const VolumeMesh& mesh, TetMesh& m, std::vector<std::uint32_t>& tet_of) {
    tet_of.assign(mesh->cell_count(), no_index);
    for (const auto& block : mesh->blocks) {
        if (block.type != CellType::tetrahedron) continue;
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            tet_of[c] = static_cast<std::uint32_t>(m.tets.size());
            const auto nodes = mesh->nodes_of(c);
            m.tets.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
            m.region.push_back(block.region);
            m.cells.push_back(c);
        }
    }
}

/// The facet of a tetrahedron that is a local face of its cell.
std::uint32_t facet_of(const TetMesh& m, std::uint32_t tet, const std::vector<std::uint32_t>& nodes) {
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (std::ranges::find(nodes, m.tets[tet][k]) == nodes.end()) return 4 * tet + k;
    }
    return no_index;
}

/// Numbers facets by the sets that they and their other sides are in, and by the regions beside them.
class Walls {
public:
    Walls(const VolumeMesh& mesh, TetMesh& m, const std::vector<std::uint32_t>& tet_of) : mesh_(mesh), m_(m), tet_of_(tet_of) {}

    void find() {
        std::vector<std::array<std::uint32_t, 2>> in_set;  // facet, set
        for (std::uint32_t s = 0; s < mesh_->face_sets.size(); ++s) {
            for (const CellFaceRef& face : mesh_->face_sets[s].faces) {
                if (tet_of_[face.cell] == no_index) continue;
                const std::uint32_t f = facet_of(m_, tet_of_[face.cell], mesh_.nodes_of(face));
                in_set.push_back({f, s});
                if (const std::uint32_t other = m_.across[f / 4][f % 4]; other != no_index) in_set.push_back({other, s});
            }
        }
        std::ranges::sort(in_set);
        in_set.erase(std::ranges::unique(in_set).begin(), in_set.end());
        m_.wall.assign(m_.tets.size(), {0, 0, 0, 0});
        std::size_t at = 0;
        for (std::uint32_t f = 0; f < 4 * m_.tets.size(); ++f) {
            std::vector<std::uint32_t> what;
            for (; at < in_set.size() && in_set[at][0] == f; ++at) what.push_back(in_set[at][1]);
            m_.wall[f / 4][f % 4] = number_of(f, std::move(what));
        }
        hold_facets();
    }

private:
    std::uint32_t number_of(std::uint32_t f, std::vector<std::uint32_t> what) {
        const std::uint32_t other = m_.across[f / 4][f % 4];
        const std::uint32_t here = m_.region[f / 4], there = other == no_index ? no_index : m_.region[other / 4];
        if (what.empty() && here == there) return TetMesh::no_wall;
        what.push_back(std::min(here, there));
        what.push_back(std::max(here, there));
        return numbers_.try_emplace(std::move(what), static_cast<std::uint32_t>(numbers_.size()) + 2).first->second;
    }

    /// Facets with a cell of another type behind them stay triangles.
    void hold_facets() {
        std::vector<std::array<std::uint32_t, 3>> held;
        for (std::uint32_t c = 0; c < mesh_->cell_count(); ++c) {
            if (tet_of_[c] != no_index) continue;
            for (std::uint32_t f = 0; f < mesh_.face_count(c); ++f) {
                const auto nodes = mesh_.nodes_of({c, f});
                if (nodes.size() == 3) held.push_back(sorted({nodes[0], nodes[1], nodes[2]}));
            }
        }
        std::ranges::sort(held);
        for (std::uint32_t f = 0; !held.empty() && f < 4 * m_.tets.size(); ++f) {
            if (m_.across[f / 4][f % 4] == no_index && std::ranges::binary_search(held, sorted(m_.facet(f))))
                m_.wall[f / 4][f % 4] = TetMesh::held_wall;
        }
    }

    const VolumeMesh& mesh_;
    TetMesh& m_;
    const std::vector<std::uint32_t>& tet_of_;
    std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_;
};

/// An edge of a facet that lies on a wall, with the corner of the facet beyond it.
struct WallEdge {
    std::uint64_t edge;
    std::uint32_t wall, beyond;
    auto operator<=>(const WallEdge&) const = default;
};

bool has_crease(const TetMesh& m, const WallEdge& first, const WallEdge& second) {
    constexpr double cosine_of_40_degrees = 0.766;
    const Vec3 a = m.positions[first.edge >> 32], b = m.positions[first.edge & 0xffffffffu];
    const Vec3 along = minus(b, a);
    const Vec3 n1 = cross(along, minus(m.positions[first.beyond], a)), n2 = cross(minus(m.positions[second.beyond], a), along);
    return dot(n1, n2) < cosine_of_40_degrees * std::sqrt(dot(n1, n1) * dot(n2, n2));
}

void find_lines(const VolumeMesh& mesh, TetMesh& m) {
    std::vector<WallEdge> edges;
    for (std::uint32_t f = 0; f < 4 * m.tets.size(); ++f) {
        const std::uint32_t wall = m.wall[f / 4][f % 4], other = m.across[f / 4][f % 4];
        if (wall == TetMesh::no_wall || (other != no_index && other < f)) continue;
        const auto c = m.facet(f);
        for (std::size_t k = 0; k < 3; ++k) edges.push_back({pair_key(c[k], c[(k + 1) % 3]), wall, c[(k + 2) % 3]});
    }
    std::ranges::sort(edges);
    std::vector<std::uint64_t> on_walls, lines;
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
        for (end = i; end < edges.size() && edges[end].edge == edges[i].edge;) ++end;
        on_walls.push_back(edges[i].edge);
        if (end - i != 2 || edges[i].wall != edges[i + 1].wall || has_crease(m, edges[i], edges[i + 1])) lines.push_back(edges[i].edge);
    }
    for (const auto& set : mesh->edge_sets) {
        for (const auto& e : set.edges) lines.push_back(pair_key(e[0], e[1]));
    }
    m.wall_edges = PairSet(std::move(on_walls), m.positions.size());
    m.lines = PairSet(std::move(lines), m.positions.size());
}

void find_stars(TetMesh& m) {
    m.star_offsets.assign(m.positions.size() + 1, 0);
    for (const auto& tet : m.tets) {
        for (const std::uint32_t v : tet) ++m.star_offsets[v + 1];
    }
    std::partial_sum(m.star_offsets.begin(), m.star_offsets.end(), m.star_offsets.begin());
    m.star.resize(m.star_offsets.back());
    std::vector<std::uint32_t> next(m.star_offsets.begin(), m.star_offsets.end() - 1);
    for (std::uint32_t t = 0; t < m.tets.size(); ++t) {
        for (const std::uint32_t v : m.tets[t]) m.star[next[v]++] = t;
    }
}

}  // namespace

std::array<std::uint32_t, 3> TetMesh::facet(std::uint32_t number) const {
    const auto& corners = facet_corners[number % 4];
    const auto& tet = tets[number / 4];
    return {tet[corners[0]], tet[corners[1]], tet[corners[2]]};
}

void find_across(TetMesh& m) {
    std::vector<FacetKey> keys(4 * m.tets.size());
    for (std::uint32_t f = 0; f < keys.size(); ++f) keys[f] = {sorted(m.facet(f)), f};
    std::ranges::sort(keys);
    m.across.assign(m.tets.size(), {no_index, no_index, no_index, no_index});
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        if (keys[i].corners != keys[i + 1].corners) continue;
        const std::uint32_t a = keys[i].number, b = keys[i + 1].number;
        m.across[a / 4][a % 4] = b;
        m.across[b / 4][b % 4] = a;
        ++i;
    }
}

TetMesh tet_mesh_of(const VolumeMesh& mesh) {
    TetMesh m;
    m.positions = mesh->vertices;
    std::vector<std::uint32_t> tet_of;
    take_tets(mesh, m, tet_of);
    find_across(m);
    Walls(mesh, m, tet_of).find();
    find_lines(mesh, m);
    find_stars(m);
    return m;
}

}  // namespace geomend::hexes
