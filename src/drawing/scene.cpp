// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/scene.h"

#include <algorithm>

#include "drawing/parts.h"

namespace geomend {

namespace {

std::vector<bool> objects_inside(const Dataset& dataset, std::span<const Brep> breps) {
    std::vector<bool> inside(dataset.objects.size(), false);
    const auto note = [&](std::uint32_t object) {
        if (object < inside.size()) inside[object] = true;
    };
    for (const Brep& brep : breps) {
        for (const auto& surface : brep->surfaces) note(surface.source_object);
        for (const auto& region : brep->regions) note(region.source_object);
    }
    return inside;
}

ScenePart surface_part(const BrepData& brep, std::size_t s) {
    const auto& surface = brep.surfaces[s];
    ScenePart part;
    part.kind = "surface";
    part.name = surface.name;
    part.id = static_cast<std::int64_t>(s);
    part.role = surface.role;
    if (part.role == FeatureRole::unknown && surface.interface_id.valid()) part.role = brep.interfaces[surface.interface_id.value].role;
    for (const VertexId v : surface.nodes) part.points.push_back(brep.vertices[v.value]);
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) scene::add_fan(surface.polygons[p], part.triangles);
    return part;
}

ScenePart line_part(const BrepData& brep, std::size_t l) {
    ScenePart part;
    part.kind = "line";
    part.name = brep.lines[l].name;
    part.id = static_cast<std::int64_t>(l);
    for (const VertexId v : brep.lines[l].vertices) part.points.push_back(brep.vertices[v.value]);
    part.polylines.emplace_back(part.points.size());
    for (std::uint32_t i = 0; i < part.points.size(); ++i) part.polylines[0][i] = i;
    return part;
}

ScenePart corner_part(const BrepData& brep, std::size_t c) {
    ScenePart part;
    part.kind = "corner";
    part.name = brep.corners[c].name;
    part.id = static_cast<std::int64_t>(c);
    part.points = {brep.vertices[brep.corners[c].vertex.value]};
    return part;
}

void add_brep(const BrepData& brep, std::vector<ScenePart>& parts) {
    for (std::size_t s = 0; s < brep.surfaces.size(); ++s) parts.push_back(surface_part(brep, s));
    for (std::size_t l = 0; l < brep.lines.size(); ++l) parts.push_back(line_part(brep, l));
    for (std::size_t c = 0; c < brep.corners.size(); ++c) parts.push_back(corner_part(brep, c));
}

}  // namespace

Scene make_scene(const Dataset& dataset, std::span<const Brep> breps) {
    Scene scene;
    const std::vector<bool> inside = objects_inside(dataset, breps);
    for (const Brep& brep : breps) add_brep(*brep, scene.parts);
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        if (!inside[i]) scene::add_parts(dataset.objects[i], scene.parts);
    }
    if (!dataset.objects.empty()) scene.crs = info_of(dataset.objects.front()).crs;
    finish(scene);
    return scene;
}

}  // namespace geomend
