// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/faces_writing.h"

#include <algorithm>

#include "base/own_name.h"
#include "base/wording.h"

namespace geomend::surfaces {

namespace {

void lose_info(const ObjectInfo& info, const Holds& holds, bool alone, const OutputSet& out, std::vector<Loss>& losses) {
    const std::string why = std::string(holds.title) + " has no place for it";
    const auto lost = [&](LossClass c, std::string what, std::uint64_t count = 1) {
        add_loss(losses, {c, info.name, std::move(what), why, count});
    };
    if (!info.name.empty() && !holds.names && !(alone && info.name == out.stem())) lost(LossClass::identity, "name");
    if (info.role != FeatureRole::unknown || !info.role_text.empty()) lost(LossClass::identity, "role");
    if (!info.feature.empty()) lost(LossClass::identity, "geological feature");
    if (!info.groups.empty()) lost(LossClass::identity, "groups");
    for (const NamedSet& set : info.sets) lost(LossClass::substance, "set '" + set.name + "'");
    if (!info.annotations.empty()) lost(LossClass::style, "header lines of the source format", info.annotations.size());
    const CoordinateSystem& crs = info.crs;
    if (!crs.name.empty() || !crs.projection.empty() || !crs.datum.empty()) lost(LossClass::identity, "coordinate system");
    if (std::ranges::any_of(crs.axis_units, [](const std::string& unit) { return !unit.empty(); }))
        lost(LossClass::identity, "units of the axes");
    if (crs.z_positive_stated) lost(LossClass::identity, "sign of z");
    for (const Attribute& a : info.attributes) {
        const bool at_place = a.location == AttributeLocation::point || a.location == AttributeLocation::polygon;
        const bool text = std::holds_alternative<std::vector<std::string>>(a.values);
        if (!holds.attributes || !alone || !at_place || text) lost(LossClass::substance, "attribute '" + a.name + "'");
        else if (!a.unit.empty()) lost(LossClass::identity, "unit of attribute '" + a.name + "'");
    }
}

/// The flat cells of a mesh; the number of others.
std::uint64_t add_flat_cells(const CellMesh& mesh, std::uint32_t first, Polygons& polygons) {
    std::uint64_t others = 0;
    std::vector<std::uint32_t> corners;
    for (std::size_t c = 0; c < mesh.types.size(); ++c) {
        const CellType type = mesh.types[c];
        if (type != CellType::triangle && type != CellType::quad && type != CellType::polygon) {
            ++others;
            continue;
        }
        corners.clear();
        for (std::uint64_t k = mesh.offsets[c]; k < mesh.offsets[c + 1]; ++k) corners.push_back(first + mesh.nodes[k]);
        polygons.push_back(corners);
    }
    return others;
}

/// Every polygon as the fan of its first corner.
Polygons fans_of(const Polygons& polygons, std::vector<WrittenFaces::Surface>& surfaces) {
    Polygons fans;
    std::size_t s = 0;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        for (; s < surfaces.size() && surfaces[s].first_polygon == p; ++s) surfaces[s].first_polygon = fans.size();
        const auto polygon = polygons[p];
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) fans.push_back(std::array{polygon[0], polygon[k], polygon[k + 1]});
    }
    for (; s < surfaces.size(); ++s) surfaces[s].first_polygon = fans.size();
    return fans;
}

}  // namespace

Result<WrittenFaces> faces_for_writing(const Dataset& dataset, const Holds& holds, const OutputSet& out, std::vector<Loss>& losses) {
    WrittenFaces faces;
    const std::string why = std::string(holds.title) + " holds surfaces only";
    for (const Object& object : dataset.objects) {
        const auto* surface = std::get_if<Surface>(&object);
        const auto* mesh = std::get_if<CellMesh>(&object);
        const auto first = static_cast<std::uint32_t>(faces.points.size());
        const std::size_t before = faces.polygons.size();
        if (surface != nullptr) {
            std::vector<std::uint32_t> corners;
            for (std::size_t p = 0; p < surface->polygons.size(); ++p) {
                corners.assign(surface->polygons[p].begin(), surface->polygons[p].end());
                for (std::uint32_t& c : corners) c += first;
                faces.polygons.push_back(corners);
            }
        } else if (mesh != nullptr) {
            if (const std::uint64_t others = add_flat_cells(*mesh, first, faces.polygons); others > 0)
                add_loss(losses, {LossClass::substance, mesh->info.name, "cells that are no triangles, quads or polygons", why, others});
        }
        if (faces.polygons.size() == before) {
            if (mesh == nullptr || mesh->types.empty())
                add_loss(losses, {LossClass::substance, info_of(object).name, kind_name(object), why});
            continue;
        }
        const auto& points = surface != nullptr ? surface->points : mesh->points;
        faces.points.insert(faces.points.end(), points.begin(), points.end());
        faces.surfaces.push_back({&info_of(object), first, before});
    }
    if (faces.surfaces.empty())
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, why + ", and there is none to write");
    for (const auto& s : faces.surfaces) lose_info(*s.info, holds, faces.surfaces.size() == 1, out, losses);
    for (const StatedModel& model : dataset.models)
        add_loss(losses, {LossClass::substance, model.name, "regions, contacts and layers", std::string(holds.title) + " holds no model"});
    if (const std::size_t records = kept_records(dataset); records > 0)
        add_loss(losses, {LossClass::style, "", "header lines of the file", std::string(holds.title) + " has no place for them", records});
    if (holds.polygons || faces.polygons.all_triangles()) return faces;
    const std::size_t polygons = faces.polygons.size();
    faces.polygons = fans_of(faces.polygons, faces.surfaces);
    add_loss(losses, {LossClass::identity, "", "which triangles make a polygon", std::string(holds.title) + " holds triangles only",
                      faces.polygons.size() - polygons});
    return faces;
}

std::string name_in_file(std::string_view stated, std::size_t place, std::set<std::string>& names, std::vector<Loss>& losses) {
    const std::string first = stated.empty() ? "surface " + std::to_string(place + 1) : std::string(stated);
    std::string name = own_name(first, names);
    if (name != first)
        add_loss(losses, {LossClass::identity, first, "name", "another object has it: this one is called " + geomend::quoted(name), 1});
    return name;
}

}  // namespace geomend::surfaces
