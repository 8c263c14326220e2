// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/kept_cells.h"

#include <algorithm>
#include <map>
#include <utility>

#include "model/attribute_operations.h"
#include "model/mesh_needs.h"

namespace geomend::exchange {

namespace {

using Data = VolumeMeshData;
using Numbers = std::vector<std::uint32_t>;

class Subset {
public:
    Subset(const Data& from, std::span<const std::uint8_t> kept, KeptNodes nodes) : from_(from), kept_(kept), nodes_(nodes) {}

    Data run() {
        to_.name = from_.name;
        to_.crs = from_.crs;
        to_.regions = from_.regions;
        to_.surfaces = from_.surfaces;
        to_.lines = from_.lines;
        to_.corners = from_.corners;
        take_cells();
        take_vertices();
        take_face_sets();
        take_edge_sets();
        take_node_sets();
        take_attributes();
        return std::move(to_);
    }

private:
    void take_cells() {
        cell_of_.assign(from_.cell_count(), no_index);
        // Types of one linear type may become one: blocks are gathered anew.
        std::map<std::pair<std::uint32_t, CellType>, Numbers> blocks;
        for (const Data::Block& block : from_.blocks) {
            for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
                if (kept_[c] != 0) blocks[{block.region, type_with(block.type, nodes_)}].push_back(c);
            }
        }
        const bool faces = std::ranges::any_of(blocks, [](const auto& b) { return b.first.second == CellType::polyhedron; });
        if (faces) to_.cell_faces = to_.face_offsets = {0};
        for (const auto& [key, cells] : blocks) {
            to_.blocks.push_back(
                {key.first, key.second, static_cast<std::uint32_t>(cells_.size()), static_cast<std::uint32_t>(cells.size())});
            for (const std::uint32_t c : cells) take_cell(key.second, c, faces);
        }
    }

    void take_cell(CellType type, std::uint32_t c, bool faces) {
        cell_of_[c] = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back(c);
        auto nodes = from_.nodes_of(c);
        if (const std::uint32_t count = node_count(type); count > 0) nodes = nodes.first(count);
        to_.cell_nodes.insert(to_.cell_nodes.end(), nodes.begin(), nodes.end());
        to_.cell_offsets.push_back(to_.cell_nodes.size());
        if (!faces) return;
        for (std::uint64_t f = from_.cell_faces[c]; f < from_.cell_faces[c + 1]; ++f) {
            for (std::uint64_t k = from_.face_offsets[f]; k < from_.face_offsets[f + 1]; ++k) to_.face_nodes.push_back(from_.face_nodes[k]);
            to_.face_offsets.push_back(to_.face_nodes.size());
        }
        to_.cell_faces.push_back(to_.face_offsets.size() - 1);
    }

    void take_vertices() {
        vertex_of_.assign(from_.vertices.size(), no_index);
        for (const std::uint32_t v : to_.cell_nodes) vertex_of_[v] = 0;
        for (std::uint32_t v = 0; v < vertex_of_.size(); ++v) {
            if (vertex_of_[v] == no_index) continue;
            vertex_of_[v] = static_cast<std::uint32_t>(vertices_.size());
            vertices_.push_back(v);
            to_.vertices.push_back(from_.vertices[v]);
            if (!from_.vertex_places.empty()) to_.vertex_places.push_back(from_.vertex_places[v]);
        }
        for (std::uint32_t& v : to_.cell_nodes) v = vertex_of_[v];
        for (std::uint32_t& v : to_.face_nodes) v = vertex_of_[v];
        if (from_.vertex_origins.empty()) return;
        Numbers first(from_.vertices.size(), no_index);  // per origin the first vertex that is left
        for (const std::uint32_t v : vertices_) {
            std::uint32_t& origin = first[from_.vertex_origins[v]];
            if (origin == no_index) origin = vertex_of_[v];
            to_.vertex_origins.push_back(origin);
        }
    }

    CellFaceRef face_of(const CellFaceRef& ref) const { return {cell_of_[ref.cell], ref.face}; }

    void take_face_sets() {
        for (Data::FaceSet set : from_.face_sets) {
            for (CellFaceRef& ref : set.faces) ref = face_of(ref);
            std::erase_if(set.faces, [](const CellFaceRef& ref) { return ref.cell == no_index; });
            std::ranges::sort(set.faces);
            if (!set.faces.empty()) to_.face_sets.push_back(std::move(set));
        }
        for (Data::SplitPair pair : from_.split_pairs) {
            for (CellFaceRef& ref : pair.faces) ref = face_of(ref);
            if (pair.faces[0].cell != no_index && pair.faces[1].cell != no_index) to_.split_pairs.push_back(pair);
        }
    }

    void take_edge_sets() {
        for (const Data::EdgeSet& from : from_.edge_sets) {
            Data::EdgeSet set{from.name, {}};
            for (std::size_t e = 0; e < from.edges.size(); ++e) {
                const std::uint32_t a = from.edges[e][0];
                std::uint32_t b = from.edges[e][1];
                const bool goes_on = vertex_of_[b] == no_index && e + 1 < from.edges.size() && from.edges[e + 1][0] == b;
                if (goes_on) b = from.edges[++e][1];
                if (vertex_of_[a] != no_index && vertex_of_[b] != no_index && a != b) set.edges.push_back({vertex_of_[a], vertex_of_[b]});
            }
            if (!set.edges.empty()) to_.edge_sets.push_back(std::move(set));
        }
    }

    void take_node_sets() {
        for (Data::NodeSet set : from_.node_sets) {
            for (std::uint32_t& v : set.nodes) v = vertex_of_[v];
            std::erase(set.nodes, no_index);
            if (!set.nodes.empty()) to_.node_sets.push_back(std::move(set));
        }
    }

    void take_attributes() {
        for (const Attribute& a : from_.attributes) {
            if (a.location == AttributeLocation::point) to_.attributes.push_back(taken(a, vertices_));
            else if (a.location == AttributeLocation::cell) to_.attributes.push_back(taken(a, cells_));
            else to_.attributes.push_back(a);
        }
    }

    const Data& from_;
    std::span<const std::uint8_t> kept_;
    KeptNodes nodes_;
    Data to_;
    Numbers cell_of_, vertex_of_, cells_, vertices_;  // new numbers of old ones, and the other way round
};

}  // namespace

CellType type_with(CellType type, KeptNodes nodes) {
    if (nodes == KeptNodes::corners) return linear_type(type);
    if (nodes == KeptNodes::all || !has_middle_nodes(type)) return type;
    return type == CellType::triquadratic_hexahedron ? CellType::quadratic_hexahedron : CellType::quadratic_wedge;
}

VolumeMeshData kept_cells(const VolumeMeshData& mesh, std::span<const std::uint8_t> kept, KeptNodes nodes) {
    return Subset(mesh, kept, nodes).run();
}

}  // namespace geomend::exchange
