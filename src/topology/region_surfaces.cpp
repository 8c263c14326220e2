// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/region_surfaces.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "model/attribute_operations.h"
#include "model/cell_faces.h"
#include "topology/weld.h"

namespace geomend::topology {

namespace {

using Corners = std::vector<std::uint32_t>;

/// A facet of a cell, or a face of the mesh that is there already (entity no_index).
struct Facet {
    Corners key;    ///< vertices, ascending
    Corners nodes;  ///< in cyclic order, out of the cell
    std::uint32_t entity = no_index;
};

struct Collector {
    explicit Collector(const CellMesh& source) : mesh(source) {
        Welder welder(source.points.size());
        for (const Vec3& p : source.points) vertex_of.push_back(welder.add(p));
    }
    void add(Corners nodes, std::uint32_t entity) {
        Facet facet{{}, std::move(nodes), entity};
        for (const std::uint32_t node : facet.nodes) facet.key.push_back(vertex_of[node]);
        std::ranges::sort(facet.key);
        facets.push_back(std::move(facet));
    }
    void add_cell(std::uint32_t cell, std::uint32_t entity) {
        const auto nodes = mesh.cell_nodes(cell);
        if (mesh.types[cell] == CellType::polyhedron && !mesh.cell_faces.empty()) {
            for (std::uint64_t f = mesh.cell_faces[cell]; f < mesh.cell_faces[cell + 1]; ++f) {
                add({mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f]),
                     mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f + 1])},
                    entity);
            }
            return;
        }
        for (const LocalFace& face : faces_of(mesh.types[cell])) {
            Corners corners;
            for (const std::uint8_t i : face.corners()) corners.push_back(nodes[i]);
            add(std::move(corners), entity);
        }
    }
    const CellMesh& mesh;
    std::vector<std::uint32_t> vertex_of;
    std::vector<Facet> facets;
};

std::string name_of(const CellMesh& mesh, std::uint32_t entity) {
    if (entity == no_index) return "outside";
    const auto& e = mesh.entities[entity];
    if (!e.name.empty()) return e.name;
    for (const std::uint32_t g : e.groups) {
        if (g < mesh.groups.size() && !mesh.groups[g].name.empty()) return mesh.groups[g].name;
    }
    return "Region_" + std::to_string(e.tag);
}

CellType face_type(std::size_t corners) { return corners == 3 ? CellType::triangle : corners == 4 ? CellType::quad : CellType::polygon; }

}  // namespace

std::size_t add_region_surfaces(CellMesh& mesh) {
    if (mesh.cell_entity.size() != mesh.cell_count()) return 0;
    Collector all(mesh);
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
        const std::uint32_t e = mesh.cell_entity[c];
        const int d = dimension(mesh.types[c]);
        if (d == 3 && e < mesh.entities.size() && mesh.entities[e].dimension == 3) all.add_cell(c, e);
        if (d != 2) continue;
        auto nodes = mesh.cell_nodes(c);
        const std::uint32_t corners = node_count(linear_type(mesh.types[c]));
        if (corners != 0 && corners < nodes.size()) nodes = nodes.first(corners);
        all.add({nodes.begin(), nodes.end()}, no_index);
    }
    auto& facets = all.facets;
    std::ranges::stable_sort(facets, [](const Facet& a, const Facet& b) { return std::tie(a.key, a.entity) < std::tie(b.key, b.entity); });
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const Facet*>> surfaces;  // by entities, no_index last
    for (std::size_t i = 0; i < facets.size();) {
        std::size_t j = i + 1;
        while (j < facets.size() && facets[j].key == facets[i].key) ++j;
        const bool is_there = facets[j - 1].entity == no_index;
        const bool is_inner = j - i > 1 && facets[i].entity == facets[j - 1].entity;
        if (!is_there && !is_inner) surfaces[{facets[i].entity, j - i > 1 ? facets[j - 1].entity : no_index}].push_back(&facets[i]);
        i = j;
    }
    std::int64_t tag = 0;
    for (const auto& e : mesh.entities) tag = e.dimension == 2 ? std::max(tag, e.tag) : tag;
    std::int64_t label = 0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) label = std::max(label, mesh.cell_labels[c]);
    std::size_t added = 0;
    const std::size_t before = mesh.cell_count();
    for (const auto& [sides, faces] : surfaces) {
        CellMesh::Entity entity;
        entity.dimension = 2;
        entity.tag = ++tag;
        entity.name = name_of(mesh, sides.first) + "_" + name_of(mesh, sides.second);
        entity.role = sides.second == no_index ? FeatureRole::boundary : FeatureRole::unknown;
        mesh.entities.push_back(std::move(entity));
        for (const std::uint32_t side : {sides.first, sides.second}) {
            if (side != no_index && !mesh.entities[side].boundary.empty())
                mesh.entities[side].boundary.push_back(side == sides.first ? tag : -tag);
        }
        for (const Facet* facet : faces) {
            mesh.add_cell(face_type(facet->nodes.size()), facet->nodes);
            mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size() - 1));
            ++added;
        }
    }
    if (added == 0) return 0;
    if (!mesh.cell_labels.ids.empty()) {
        for (std::size_t k = 0; k < added; ++k) mesh.cell_labels.ids.push_back(++label);
    }
    for (Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::cell) resize_with_missing(a, before + added);
    }
    return added;
}

}  // namespace geomend::topology
