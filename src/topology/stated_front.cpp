// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>

#include "base/parallel.h"
#include "topology/faces_from_surfaces.h"
#include "topology/front_ends.h"
#include "topology/mesh_parts.h"

namespace geomend::topology {

namespace {

bool is_there(const Dataset& dataset, const StatedModel::Face& face) {
    if (face.object >= dataset.objects.size()) return false;
    if (const auto* surface = std::get_if<Surface>(&dataset.objects[face.object])) return face.part < part_count(*surface);
    const auto* mesh = std::get_if<CellMesh>(&dataset.objects[face.object]);
    return mesh != nullptr && face.part < mesh->entities.size() && mesh->entities[face.part].dimension == 2;
}

/// Meshes without entities (MSH with a section of ours) fill the regions of the model that lists them by name.
bool fills_region(const CellMesh& mesh, const StatedModel& model) {
    return mesh.entities.empty() && std::ranges::any_of(model.regions, [&](const auto& region) {
               return !region.universe && !region.name.empty() && region.name == mesh.info.name;
           });
}

using MeshTable = std::map<std::uint32_t, MeshParts>;

void add_faces(const Dataset& dataset, const StatedModel& model, std::span<const std::uint32_t> stated, const MeshTable& meshes,
               const WeldedPoints& points, SurfaceComplex& complex) {
    complex.faces.resize(stated.size());
    parallel_for_each_index(stated.size(), [&](std::size_t f) {
        const auto& face = model.faces[stated[f]];
        const Object& object = dataset.objects[face.object];
        const ObjectInfo& info = info_of(object);
        auto& made = complex.faces[f];
        if (const auto mesh = meshes.find(face.object); mesh != meshes.end()) {
            made = face_of_entity(mesh->second, face.part, points);
        } else {
            made = face_of_part(std::get<Surface>(object), face.object, face.part, points);
        }
        const bool own_role = face.role != FeatureRole::unknown || !face.role_text.empty();
        made.surface.name = face.name;
        made.surface.role = own_role ? face.role : info.role;
        made.surface.role_text = own_role ? face.role_text : info.role_text;
        made.interface_name = face.interface_name.empty() ? info.name : face.interface_name;
        made.number = face.number;
        if (face.key) made.key = {points.at((*face.key)[0]), points.at((*face.key)[1]), points.at((*face.key)[2])};
    });
}

void add_corners(const Dataset& dataset, const StatedModel& model, std::span<const std::uint32_t> objects, const WeldedPoints& points,
                 SurfaceComplex& complex) {
    for (const std::uint32_t o : objects) add_corner_hints(dataset.objects[o], points.of.at(o), complex);
    for (const auto& corner : model.corners) {
        const std::uint32_t v = points.at(corner.position);
        if (v == no_index) continue;
        complex.lines.corners.push_back(v);
        complex.corner_names.push_back({v, corner.name});
    }
}

void add_interfaces(const Dataset& dataset, const StatedModel& model, SurfaceComplex& complex) {
    std::set<std::string_view> known;
    for (const auto& face : complex.faces) {
        const Object& object = dataset.objects[face.surface.source_object];
        if (!known.insert(face.interface_name).second || std::holds_alternative<CellMesh>(object)) continue;
        complex.interfaces.push_back({face.interface_name, info_of(object).feature, info_of(object).annotations});
    }
    for (const auto& said : model.interfaces) complex.interfaces.push_back({said.name, said.feature, said.annotations});
}

/// \param face_of per face of the model its number in the complex, or no_index
void add_features(const StatedModel& model, std::span<const std::uint32_t> face_of, SurfaceComplex& complex) {
    for (const auto& feature : model.features) {
        auto& made = complex.features.emplace_back(SurfaceComplex::Feature{feature.name, {}});
        for (const std::uint32_t f : feature.faces) {
            if (f < face_of.size() && face_of[f] != no_index) made.faces.push_back(face_of[f]);
        }
    }
}

void add_regions(const StatedModel& model, std::span<const std::uint32_t> face_of, SurfaceComplex& complex) {
    for (const auto& region : model.regions) {
        StatedRegion made{region.name, region.universe, {}};
        for (const auto& side : region.sides) {
            const std::uint32_t f = side.face < face_of.size() ? face_of[side.face] : no_index;
            if (f != no_index) made.sides.push_back({SurfaceId(f), side.front});
        }
        complex.regions.push_back(std::move(made));
    }
    const auto lists = [](const std::vector<StatedModel::RegionList>& from, std::vector<SurfaceComplex::RegionList>& to) {
        for (const auto& list : from) to.push_back({list.name, list.regions, list.unresolved});
    };
    lists(model.layers, complex.layers);
    lists(model.fault_blocks, complex.fault_blocks);
}

void add_fillings(const Dataset& dataset, std::span<const std::uint32_t> objects, const WeldedPoints& points, SurfaceComplex& complex) {
    for (const std::uint32_t o : objects) {
        const auto* mesh = std::get_if<CellMesh>(&dataset.objects[o]);
        if (mesh == nullptr || !mesh->entities.empty()) continue;
        SurfaceComplex::Filling filling{static_cast<std::uint32_t>(complex.meshes.size()), mesh->info.name, {}};
        for (std::uint32_t c = 0; c < mesh->cell_count(); ++c) {
            if (dimension(mesh->types[c]) == 3) filling.cells.push_back(c);
        }
        if (filling.cells.empty()) continue;
        complex.meshes.push_back({mesh, o, points.of.at(o)});
        complex.fillings.push_back(std::move(filling));
    }
}

}  // namespace

std::vector<std::uint32_t> objects_of(const Dataset& dataset, const StatedModel& model) {
    std::vector<std::uint8_t> used(dataset.objects.size(), 0);
    for (const auto& face : model.faces) {
        if (is_there(dataset, face)) used[face.object] = 1;
    }
    std::vector<std::uint32_t> objects;
    for (std::uint32_t o = 0; o < used.size(); ++o) {
        const auto* mesh = std::get_if<CellMesh>(&dataset.objects[o]);
        if (used[o] != 0 || (mesh != nullptr && fills_region(*mesh, model))) objects.push_back(o);
    }
    return objects;
}

SurfaceComplex complex_of_stated_model(const Dataset& dataset, const StatedModel& model, std::span<const WeldGroup> groups) {
    const auto objects = objects_of(dataset, model);
    WeldedPoints points = weld_points(dataset, groups);
    std::vector<std::uint32_t> stated, face_of(model.faces.size(), no_index);
    MeshTable meshes;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        const auto& face = model.faces[f];
        if (!is_there(dataset, face)) continue;
        face_of[f] = static_cast<std::uint32_t>(stated.size());
        stated.push_back(f);
        const auto* mesh = std::get_if<CellMesh>(&dataset.objects[face.object]);
        if (mesh != nullptr && !meshes.contains(face.object)) meshes.emplace(face.object, parts_of_mesh(*mesh, face.object));
    }
    SurfaceComplex complex;
    const ObjectInfo& first = info_of(dataset.objects[objects.front()]);
    complex.name = model.name.empty() ? first.name : model.name;
    complex.crs = model.crs.stated ? model.crs : first.crs;
    complex.annotations = model.annotations;
    for (const Finding& finding : dataset.findings) complex.reported.push_back(finding.code);
    report_welding(points, complex);
    add_faces(dataset, model, stated, meshes, points, complex);
    add_corners(dataset, model, objects, points, complex);
    for (const auto& [object, parts] : meshes) add_lines_of_mesh(parts, points, complex);
    add_interfaces(dataset, model, complex);
    add_features(model, face_of, complex);
    add_regions(model, face_of, complex);
    for (const auto& [object, parts] : meshes) add_volumes_of_mesh(parts, points, complex);
    add_fillings(dataset, objects, points, complex);
    give_vertices(points, complex);
    return complex;
}

}  // namespace geomend::topology
