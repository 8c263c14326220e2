// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/dataset.h"

namespace geomend::test {

/// A unit cube from z0 up as a mesh: a face entity for each side (without the lowest where `open`), the cell as a volume, and a
/// named corner and a named line that states the lowest edge. Points that nothing uses come first, so that two such meshes
/// number their points differently.
inline CellMesh block_mesh(const std::string& name, double z0, bool open, std::uint32_t unused) {
    CellMesh mesh;
    mesh.info.name = name;
    for (std::uint32_t i = 0; i < unused; ++i) mesh.points.push_back({100.0 + i, 100, z0});
    for (const double z : {z0, z0 + 1}) {
        for (const auto& [x, y] : {std::array{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) mesh.points.push_back({x, y, z});
    }
    const auto add = [&](int dimension, const std::string& entity_name, CellType type, std::vector<std::uint32_t> nodes) {
        for (std::uint32_t& n : nodes) n += unused;
        CellMesh::Entity entity;
        entity.dimension = dimension;
        entity.tag = static_cast<std::int64_t>(mesh.entities.size()) + 1;
        entity.name = entity_name;
        mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size()));
        mesh.entities.push_back(entity);
        mesh.add_cell(type, nodes);
    };
    add(0, name + " corner", CellType::vertex, {4});
    add(1, name + " line", CellType::line, {6, 7});
    if (!open) add(2, name + " low", CellType::quad, {0, 3, 2, 1});
    add(2, name + " high", CellType::quad, {4, 5, 6, 7});
    add(2, name + " south", CellType::quad, {0, 1, 5, 4});
    add(2, name + " east", CellType::quad, {1, 2, 6, 5});
    add(2, name + " north", CellType::quad, {2, 3, 7, 6});
    add(2, name + " west", CellType::quad, {3, 0, 4, 7});
    add(3, name + " cells", CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
    return mesh;
}

/// Two such blocks on top of each other, and one model stated over the faces of both.
inline Dataset model_over_two_meshes() {
    Dataset data;
    data.objects.emplace_back(block_mesh("lower", 0, false, 0));
    data.objects.emplace_back(block_mesh("upper", 1, true, 40));
    StatedModel& model = data.models.emplace_back();
    model.name = "two blocks";
    for (std::uint32_t o = 0; o < 2; ++o) {
        const auto& entities = std::get<CellMesh>(data.objects[o]).entities;
        for (std::uint32_t e = 0; e < entities.size(); ++e) {
            if (entities[e].dimension != 2) continue;
            StatedModel::Face face;
            face.number = static_cast<std::int64_t>(model.faces.size()) + 1;
            face.object = o;
            face.part = e;
            face.name = face.interface_name = entities[e].name;
            model.faces.push_back(face);
        }
    }
    model.regions.push_back({1, "lower cells", false, {{0, false}, {1, false}}});
    model.regions.push_back({2, "upper cells", false, {{1, true}}});
    model.layers.push_back({"all", {0, 1}, {}});
    return data;
}

}  // namespace geomend::test
