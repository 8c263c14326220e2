// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/cell_mesh_of.h"

#include <array>
#include <string>

#include "model/attribute_operations.h"

namespace geomend::exchange {

namespace {

std::uint32_t add_entity(CellMesh& mesh, int dimension, const std::string& name, FeatureRole role) {
    CellMesh::Entity entity;
    entity.dimension = dimension;
    entity.tag = static_cast<std::int64_t>(mesh.entities.size()) + 1;
    entity.name = name;
    entity.role = role;
    mesh.entities.push_back(std::move(entity));
    return static_cast<std::uint32_t>(mesh.entities.size() - 1);
}

void add_cells(const VolumeMesh& from, CellMesh& to) {
    std::vector<std::uint32_t> entity_of(from->regions.size(), no_index);
    for (const VolumeMeshData::Block& block : from->blocks) {
        if (entity_of[block.region] == no_index)
            entity_of[block.region] = add_entity(to, 3, from->regions[block.region], FeatureRole::unknown);
        to.types.resize(block.first + block.count, block.type);
        to.cell_entity.resize(block.first + block.count, entity_of[block.region]);
    }
    to.offsets = from->cell_offsets;
    to.nodes = from->cell_nodes;
    to.cell_faces = from->cell_faces;
    to.face_offsets = from->face_offsets;
    to.face_nodes = from->face_nodes;
}

/// A surface with cells on both sides is there once, with the points of its first side: those of the other side lie at the same places.
void add_sets(const VolumeMesh& from, CellMesh& to) {
    std::vector<std::uint8_t> is_there(from->surfaces.size(), 0);
    for (const auto& set : from->face_sets) {
        if (set.surface != no_index && is_there[set.surface] != 0) continue;
        if (set.surface != no_index) is_there[set.surface] = 1;
        const std::uint32_t entity = add_entity(to, 2, set.surface != no_index ? from->surfaces[set.surface] : set.name, set.role);
        for (const CellFaceRef& face : set.faces) {
            const auto nodes = from.nodes_of(face);
            to.add_cell(nodes.size() == 3 ? CellType::triangle : nodes.size() == 4 ? CellType::quad : CellType::polygon, nodes);
            to.cell_entity.push_back(entity);
        }
    }
    for (const auto& set : from->edge_sets) {
        const std::uint32_t entity = add_entity(to, 1, set.name, FeatureRole::unknown);
        for (const auto& edge : set.edges) {
            to.add_cell(CellType::line, edge);
            to.cell_entity.push_back(entity);
        }
    }
    for (const auto& set : from->node_sets) to.info.sets.push_back({set.name, AttributeLocation::point, set.nodes});
}

/// For each point the number, from 0, of the one that it was doubled from.
Attribute origins_of(std::span<const std::uint32_t> origins) {
    Attribute a;
    a.name = doubled_from;
    a.location = AttributeLocation::point;
    a.values = std::vector<std::int64_t>(origins.begin(), origins.end());
    return a;
}

}  // namespace

CellMesh cell_mesh_of(const VolumeMesh& mesh) {
    CellMesh made;
    made.info.name = mesh->name;
    made.info.crs = mesh->crs;
    made.points = mesh->vertices;
    add_cells(mesh, made);
    add_sets(mesh, made);
    made.info.attributes = mesh->attributes;
    for (Attribute& a : made.info.attributes) {
        if (a.location == AttributeLocation::cell) resize_with_missing(a, made.cell_count());
    }
    if (!mesh->vertex_origins.empty()) made.info.attributes.push_back(origins_of(mesh->vertex_origins));
    return made;
}

}  // namespace geomend::exchange
