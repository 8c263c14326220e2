// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/solid_cells.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "exchange/turned_cell.h"
#include "geometry/measures.h"
#include "geometry/polyhedron_volume.h"
#include "topology/mesh_parts.h"

namespace geomend::exchange {

namespace {

using Nodes = std::vector<std::uint32_t>;

/// Per point the first of those that are stated to be one with it.
Nodes joined_points(const CellMesh& mesh) {
    DisjointSets sets(mesh.points.size());
    for (std::uint32_t p = 0; p < mesh.alias.size(); ++p) {
        if (mesh.alias[p] != no_index) sets.join(p, mesh.alias[p]);
    }
    return std::move(sets).roots();
}

bool has_repetition(Nodes nodes) {
    std::ranges::sort(nodes);
    return std::ranges::adjacent_find(nodes) != nodes.end();
}

/// Whether each edge of some faces is run along once in either direction.
bool is_closed(const std::vector<Nodes>& faces) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Nodes& face : faces) {
        for (std::size_t i = 0; i < face.size(); ++i) edges.emplace_back(face[i], face[(i + 1) % face.size()]);
    }
    std::ranges::sort(edges);
    if (edges.empty() || std::ranges::adjacent_find(edges) != edges.end()) return false;
    return std::ranges::all_of(edges, [&](const auto& e) { return std::ranges::binary_search(edges, std::pair(e.second, e.first)); });
}

class Sorter {
public:
    Sorter(const CellMesh& mesh, std::vector<Loss>& losses) : m_(mesh), losses_(losses), points_(joined_points(mesh)) {}

    SolidCells run() {
        out_.data.name = m_.info.name;
        out_.data.crs = m_.info.crs;
        for (const auto& [region, type, cell] : ordered_cells()) add(region, type, cell);
        number_vertices();
        return std::move(out_);
    }

private:
    using Place = std::tuple<std::uint32_t, CellType, std::uint32_t>;  // region, type, cell

    std::vector<Place> ordered_cells() {
        std::vector<std::uint32_t> region_of(m_.entities.size(), no_index);
        std::vector<std::uint8_t> filled(m_.entities.size(), 0);
        const auto entity_of = [&](std::size_t c) {
            const std::uint32_t e = m_.cell_entity.empty() ? no_index : m_.cell_entity[c];
            return e != no_index && m_.entities[e].dimension == 3 ? e : no_index;
        };
        for (std::size_t c = 0; c < m_.cell_count(); ++c) {
            if (dimension(m_.types[c]) == 3 && entity_of(c) != no_index) filled[entity_of(c)] = 1;
        }
        for (std::uint32_t e = 0; e < filled.size(); ++e) {
            if (filled[e] == 0) continue;
            region_of[e] = static_cast<std::uint32_t>(out_.data.regions.size());
            out_.data.regions.push_back(topology::entity_name(m_, m_.entities[e], "Region"));
        }
        const auto rest = static_cast<std::uint32_t>(out_.data.regions.size());
        std::vector<Place> cells;
        for (std::uint32_t c = 0; c < m_.cell_count(); ++c) {
            if (dimension(m_.types[c]) != 3) continue;
            const std::uint32_t e = entity_of(c);
            if (e == no_index && out_.data.regions.size() == rest)
                out_.data.regions.push_back(m_.info.name.empty() ? "cells" : m_.info.name);
            cells.emplace_back(e == no_index ? rest : region_of[e], m_.types[c], c);
        }
        std::ranges::sort(cells);
        return cells;
    }

    void add(std::uint32_t region, CellType type, std::uint32_t cell) {
        Nodes nodes;
        for (const std::uint32_t p : m_.cell_nodes(cell)) nodes.push_back(points_[p]);
        std::vector<Nodes> faces;
        if (type == CellType::polyhedron) {
            faces = outward_faces(cell);
            if (!is_closed(faces)) return leave_out(region, "polyhedra whose faces do not close");
            nodes.clear();
            for (const Nodes& face : faces) nodes.insert(nodes.end(), face.begin(), face.end());
            std::ranges::sort(nodes);
            nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
        } else if (cell_volume(m_, cell) < 0) {
            for (const auto& [a, b] : turning_swaps(type)) std::swap(nodes[a], nodes[b]);
        }
        if (has_repetition(nodes) || std::ranges::any_of(faces, has_repetition)) return leave_out(region, "cells that use a point twice");
        append(region, type, nodes, faces);
        out_.source_cells.push_back(cell);
    }

    /// The faces of a polyhedron with normals that point out of it, if they close.
    std::vector<Nodes> outward_faces(std::uint32_t cell) const {
        std::vector<Nodes> faces;
        if (m_.cell_faces.empty()) return faces;
        const std::vector<bool> turn = faces_to_turn(m_, cell);
        const bool inside_out = cell_volume(m_, cell) < 0;
        const std::uint64_t first = m_.cell_faces[cell];
        for (std::uint64_t f = first; f < m_.cell_faces[cell + 1]; ++f) {
            Nodes& face = faces.emplace_back();
            for (std::uint64_t k = m_.face_offsets[f]; k < m_.face_offsets[f + 1]; ++k) face.push_back(points_[m_.face_nodes[k]]);
            if ((!turn.empty() && turn[f - first]) != inside_out) std::ranges::reverse(face);
        }
        return faces;
    }

    void append(std::uint32_t region, CellType type, const Nodes& nodes, const std::vector<Nodes>& faces) {
        VolumeMeshData& d = out_.data;
        if (d.blocks.empty() || d.blocks.back().region != region || d.blocks.back().type != type)
            d.blocks.push_back({region, type, static_cast<std::uint32_t>(d.cell_count()), 0});
        ++d.blocks.back().count;
        d.cell_nodes.insert(d.cell_nodes.end(), nodes.begin(), nodes.end());
        d.cell_offsets.push_back(d.cell_nodes.size());
        if (!faces.empty() && d.cell_faces.empty()) {
            d.cell_faces.assign(d.cell_count(), 0);  // the cells before it have none
            d.face_offsets = {0};
        }
        for (const Nodes& face : faces) {
            d.face_nodes.insert(d.face_nodes.end(), face.begin(), face.end());
            d.face_offsets.push_back(d.face_nodes.size());
        }
        if (!d.cell_faces.empty()) d.cell_faces.push_back(d.face_offsets.size() - 1);
    }

    void leave_out(std::uint32_t region, const char* what) {
        add_loss(losses_, {LossClass::substance, out_.data.regions[region], what, "no cell of a volume mesh", 1});
    }

    /// Numbers points as vertices, in the order of the mesh's points.
    void number_vertices() {
        VolumeMeshData& d = out_.data;
        std::vector<std::uint32_t> vertex(m_.points.size(), no_index);
        for (const std::uint32_t p : d.cell_nodes) vertex[p] = 0;
        for (std::uint32_t p = 0; p < vertex.size(); ++p) {
            if (vertex[p] == no_index) continue;
            vertex[p] = static_cast<std::uint32_t>(d.vertices.size());
            d.vertices.push_back(m_.points[p]);
        }
        for (std::uint32_t& p : d.cell_nodes) p = vertex[p];
        for (std::uint32_t& p : d.face_nodes) p = vertex[p];
        out_.vertex_of.resize(points_.size());
        for (std::size_t p = 0; p < points_.size(); ++p) out_.vertex_of[p] = vertex[points_[p]];
        find_places();
    }

    void find_places() {
        VolumeMeshData& d = out_.data;
        out_.places = topology::Welder(d.vertices.size());
        std::vector<std::uint32_t> first;  // per place
        bool doubled = false;
        d.vertex_origins.resize(d.vertices.size());
        for (std::uint32_t v = 0; v < d.vertices.size(); ++v) {
            const std::uint32_t place = out_.places.add(d.vertices[v]);
            if (place == first.size()) first.push_back(v);
            doubled = doubled || first[place] != v;
            out_.place_of.push_back(place);
            d.vertex_origins[v] = first[place];
        }
        if (!doubled) d.vertex_origins.clear();
    }

    const CellMesh& m_;
    std::vector<Loss>& losses_;
    Nodes points_;
    SolidCells out_;
};

}  // namespace

SolidCells solid_cells(const CellMesh& mesh, std::vector<Loss>& losses) { return Sorter(mesh, losses).run(); }

}  // namespace geomend::exchange
