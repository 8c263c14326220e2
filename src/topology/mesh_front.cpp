// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/parallel.h"
#include "topology/front_ends.h"
#include "topology/mesh_parts.h"

namespace geomend::topology {

SurfaceComplex complex_of_tagged_mesh(const Dataset& dataset, const WeldGroup& group) {
    const std::uint32_t object = group.objects[0];
    const CellMesh& mesh = std::get<CellMesh>(dataset.objects[object]);
    WeldedPoints points = weld_points(dataset, {&group, 1});
    const MeshParts parts = parts_of_mesh(mesh, object);
    SurfaceComplex complex;
    complex.name = mesh.info.name;
    complex.crs = mesh.info.crs;
    report_welding(points, complex);
    std::vector<std::uint32_t> entities;
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        if (mesh.entities[e].dimension == 2 && !parts.entity_cells[e].empty()) entities.push_back(e);
    }
    complex.faces.resize(entities.size());
    parallel_for_each_index(entities.size(), [&](std::size_t f) {
        const auto& entity = mesh.entities[entities[f]];
        auto& face = complex.faces[f];
        face = face_of_entity(parts, entities[f], points);
        face.interface_name = entity_name(mesh, entity, "Surface");
        face.surface.role = entity.role;
        face.surface.role_text = entity.role_text;
    });
    add_lines_of_mesh(parts, points, complex);
    add_volumes_of_mesh(parts, points, complex);
    give_vertices(points, complex);
    return complex;
}

}  // namespace geomend::topology
