// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "base/codes.h"
#include "formats/drop.h"
#include "formats/ringmesh/archive.h"
#include "model/attribute_operations.h"

namespace geomend::ringmesh {

namespace {

/// Puts the values of a part behind those of the parts before it. \return false: the parts disagree on what the values are
bool append_values(Attribute& to, const Attribute& more) {
    if (to.components != more.components || to.values.index() != more.values.index()) return false;
    std::visit(
        [&](auto& all) {
            const auto& values = std::get<std::remove_reference_t<decltype(all)>>(more.values);
            all.insert(all.end(), values.begin(), values.end());
        },
        static_cast<
            std::variant<std::vector<double>, std::vector<float>, std::vector<std::int8_t>, std::vector<std::uint8_t>,
                         std::vector<std::int16_t>, std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                         std::vector<std::int64_t>, std::vector<std::uint64_t>, std::vector<std::string>>&>(to.values));
    return true;
}

std::size_t things_at(const Surface& surface, AttributeLocation location) {
    return location == AttributeLocation::point ? surface.points.size() : surface.polygons.size();
}

/// \pre the part's points and polygons are in the surface already; it had `points` and `polygons` before
void append_attributes(Surface& surface, std::vector<Attribute> part, std::size_t points, std::size_t polygons, Dataset& data) {
    for (Attribute& a : part) {
        if (a.location != AttributeLocation::point && a.location != AttributeLocation::polygon) {
            drop(
                data.findings, data.losses,
                {.entity = surface.info.name, .what = "attribute '" + a.name + "'", .why = "it stands neither on points nor on triangles"});
            continue;
        }
        auto& all = surface.info.attributes;
        auto same = std::ranges::find_if(all, [&](const Attribute& b) { return b.name == a.name && b.location == a.location; });
        if (same == all.end()) {
            same = all.insert(all.end(), without_values(a));
            same->values = taken(a.values, {}, a.components);
            resize_with_missing(*same, a.location == AttributeLocation::point ? points : polygons);
        }
        if (!append_values(*same, a))
            drop(data.findings, data.losses,
                 {.entity = surface.info.name,
                  .what = "attribute '" + a.name + "'",
                  .why = "the parts of the surface have it with several types"});
    }
    for (Attribute& a : surface.info.attributes) resize_with_missing(a, things_at(surface, a.location));
}

void append_part(Surface& surface, GeogramMesh mesh, Dataset& data) {
    const std::size_t points = surface.points.size(), polygons = surface.polygons.size();
    surface.parts.push_back({static_cast<std::uint32_t>(points), polygons});
    surface.points.insert(surface.points.end(), mesh.points.begin(), mesh.points.end());
    std::vector<std::uint32_t> polygon;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        polygon.clear();
        for (const std::uint32_t corner : mesh.facets[f]) polygon.push_back(corner + static_cast<std::uint32_t>(points));
        surface.polygons.push_back(polygon);
    }
    if (mesh.precision == CoordinatePrecision::single_precision) surface.info.precision = mesh.precision;
    append_attributes(surface, std::move(mesh.attributes), points, polygons, data);
}

}  // namespace

void build_from_surfaces(GmArchive archive, Dataset& data) {
    StatedModel& model = data.models.emplace_back();
    auto& meshes = archive.meshes[EntityText::surface];
    std::vector<std::uint32_t> face_of_surface(meshes.size(), no_index);
    keep_lines_and_corners(archive, data);
    std::vector<Object> beside = std::move(data.objects);  // behind the surfaces
    data.objects.clear();
    for (const Interface& one : interfaces_of(archive, data)) {
        Surface surface;
        surface.info.name = one.name;
        surface.info.role_text = one.feature;
        surface.info.role = feature_role(one.feature);
        for (const std::uint32_t s : one.surfaces) {
            const auto& entity = archive.text.entities[EntityText::surface][s];
            StatedModel::Face& face = model.faces.emplace_back();
            face_of_surface[s] = static_cast<std::uint32_t>(model.faces.size() - 1);
            face.number = s;
            face.object = static_cast<std::uint32_t>(data.objects.size());
            face.part = static_cast<std::uint32_t>(surface.parts.size());
            face.interface_name = one.name;
            face.name = entity.name == one.name ? std::string() : entity.name;
            face.role_text = entity.feature.empty() ? one.feature : entity.feature;
            face.role = feature_role(face.role_text);
            face.line = entity.line;
            if (meshes[s]->facets.size() == 0)
                data.findings.push_back(make_finding("F119", "Surface " + std::to_string(s) + " has no triangle",
                                                     {archive.name + "/mesh_entities.txt", entity.line}));
            append_part(surface, std::move(*meshes[s]), data);
        }
        data.objects.emplace_back(std::move(surface));
    }
    std::ranges::move(beside, std::back_inserter(data.objects));
    state_regions(archive, face_of_surface, model, data);
}

}  // namespace geomend::ringmesh
