// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/mesh_parts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "base/wording.h"
#include "model/split_sides.h"
#include "topology/faces_from_mesh.h"

namespace geomend::topology {

namespace {

/// A surface along which the cells are split is one surface, also where the mesh states it from both sides.
void leave_out_other_sides(MeshParts& parts) {
    const std::vector<std::uint32_t> side_of = other_sides(*parts.mesh);
    if (side_of.empty()) return;
    parts.numbers.resize(parts.entity_cells.size());
    for (std::size_t e = 0; e < parts.entity_cells.size(); ++e) {
        auto& cells = parts.entity_cells[e];
        std::vector<std::uint32_t> kept, numbers;
        for (std::uint32_t i = 0; i < cells.size(); ++i) {
            if (side_of[cells[i]] != no_index) continue;
            kept.push_back(cells[i]);
            numbers.push_back(i);
        }
        if (kept.size() == cells.size()) continue;
        cells = std::move(kept);
        parts.numbers[e] = std::move(numbers);
    }
}

}  // namespace

MeshParts parts_of_mesh(const CellMesh& mesh, std::uint32_t object) {
    MeshParts parts{&mesh, object, cells_by_entity(mesh), {}};
    for (std::size_t e = 0; e < mesh.entities.size(); ++e) {
        parts.filled |= mesh.entities[e].dimension == 3 && !parts.entity_cells[e].empty();
    }
    if (parts.filled) leave_out_other_sides(parts);
    return parts;
}

std::string entity_name(const CellMesh& mesh, const CellMesh::Entity& entity, const char* kind) {
    if (!entity.name.empty()) return entity.name;
    for (const std::uint32_t g : entity.groups) {
        if (g < mesh.groups.size() && !mesh.groups[g].name.empty()) return mesh.groups[g].name;
    }
    return std::string(kind) + "_" + std::to_string(entity.tag);
}

SurfaceComplex::Face face_of_entity(const MeshParts& parts, std::uint32_t entity, const WeldedPoints& points) {
    const bool point_attributes_here = !parts.filled;  // else they are the regions' own
    SurfaceComplex::Face face;
    face.surface = surface_of_cells(*parts.mesh, parts.entity_cells[entity], points.of.at(parts.object), parts.mesh->entities[entity].tag,
                                    parts.mesh->twins ? &*parts.mesh->twins : nullptr, point_attributes_here);
    face.surface.source_object = parts.object;
    face.surface.source_part = entity;
    if (entity < parts.numbers.size()) face.source_polygons = parts.numbers[entity];
    face.shared_nodes = !parts.mesh->twins;
    face.tolerance = points.tolerance.at(parts.object);
    return face;
}

SurfaceComplex::Face face_of_cells(const CellMesh& mesh, std::uint32_t object, const MeshSurface& cells, const WeldedPoints& points) {
    SurfaceComplex::Face face;
    const std::int64_t tag = cells.entity == no_index ? -1 : mesh.entities[cells.entity].tag;
    const bool has_twins = mesh.twins.has_value() && cells.entity != no_index;
    face.surface = surface_of_cells(mesh, cells.cells, points.of.at(object), tag, has_twins ? &*mesh.twins : nullptr, true);
    face.surface.role = cells.role;
    face.surface.role_text = cells.role_text;
    face.surface.source_object = object;
    face.surface.source_part = cells.part;
    face.source_polygons = cells.cells;
    face.interface_name = cells.name;
    face.tolerance = points.tolerance.at(object);
    return face;
}

void add_lines_of_mesh(const MeshParts& parts, const WeldedPoints& points, SurfaceComplex& complex) {
    const CellMesh& mesh = *parts.mesh;
    const auto& vertex_of = points.of.at(parts.object);
    const StatedLines own = stated_lines(mesh, parts.entity_cells, vertex_of);
    const auto first_line = static_cast<std::uint32_t>(complex.line_names.size());
    for (auto edge : own.edges) {
        edge.line += first_line;
        complex.lines.edges.push_back(edge);
    }
    complex.lines.corners.insert(complex.lines.corners.end(), own.corners.begin(), own.corners.end());
    complex.lines.shared_nodes |= !mesh.twins;
    for (std::size_t e = 0; e < mesh.entities.size(); ++e) {
        const auto& entity = mesh.entities[e];
        complex.line_names.push_back(entity.name);
        if (entity.dimension != 0 || entity.name.empty()) continue;
        for (const std::uint32_t c : parts.entity_cells[e]) {
            for (const std::uint32_t p : mesh.cell_nodes(c)) complex.corner_names.push_back({vertex_of[p], entity.name});
        }
    }
}

namespace {

/// What is said of a volume of a mesh that has no cells, and of whose surfaces some have no elements, as where a mesher saves only a part
/// of a model: nothing of it can be judged.
Finding unsaved_volume(const std::string& name, std::size_t stated, std::size_t absent) {
    const std::size_t there = stated - absent;
    Finding finding =
        make_finding("F121",
                     "region '" + name + "' has no cells, and " + (there == 0 ? "none" : std::to_string(there)) + " of the " +
                         counted(stated, "surface that bounds", "surfaces that bound") + " it " + (there == 1 ? "has" : "have") +
                         " elements: the file holds a part of the model, and the region is not judged",
                     {}, absent);
    finding.entities.push_back({"region", name, -1});
    return finding;
}

}  // namespace

void add_volumes_of_mesh(const MeshParts& parts, const WeldedPoints& points, SurfaceComplex& complex) {
    const CellMesh& mesh = *parts.mesh;
    std::map<std::int64_t, std::uint32_t> face_of_tag;
    for (std::uint32_t f = 0; f < complex.faces.size(); ++f) {
        const auto& surface = complex.faces[f].surface;
        if (surface.source_object == parts.object) face_of_tag.emplace(mesh.entities[surface.source_part].tag, f);
    }
    const auto number = static_cast<std::uint32_t>(complex.meshes.size());
    complex.meshes.push_back({&mesh, parts.object, points.of.at(parts.object)});
    const std::size_t before = complex.volumes.size();
    bool is_part = false;
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        if (mesh.entities[e].dimension != 3) continue;
        SurfaceComplex::Volume volume{number, parts.entity_cells[e], {entity_name(mesh, mesh.entities[e], "Region"), false, {}}};
        std::size_t absent = 0;
        for (const std::int64_t tag : mesh.entities[e].boundary) {
            const auto found = face_of_tag.find(tag < 0 ? -tag : tag);
            if (found == face_of_tag.end()) ++absent;
            else volume.boundary.sides.push_back({SurfaceId(found->second), tag < 0});  // normals point outwards
        }
        if (volume.cells.empty() && absent > 0) {
            complex.findings.push_back(unsaved_volume(volume.boundary.name, mesh.entities[e].boundary.size(), absent));
            is_part = true;
            continue;
        }
        complex.volumes.push_back(std::move(volume));
    }
    // Of a part of a model the regions without cells say nothing of what lies between them: the surfaces that are there are judged alone.
    if (is_part && !parts.filled) complex.volumes.resize(before);
}

}  // namespace geomend::topology
