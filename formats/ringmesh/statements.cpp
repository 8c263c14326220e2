// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "base/codes.h"
#include "formats/drop.h"
#include "formats/ringmesh/archive.h"

namespace geomend::ringmesh {

namespace {

std::string geology_name(const GmArchive& archive) { return archive.name + "/geological_entities.txt"; }

/// Members of a geological record that are there; the others are reported.
std::vector<std::uint32_t> known_members(const GmArchive& archive, const GeologicalText& g, EntityText::Kind kind, Dataset& data) {
    std::vector<std::uint32_t> known;
    for (const std::uint32_t member : g.members) {
        if (member < archive.text.entities[kind].size()) known.push_back(member);
        else
            drop(data.findings, data.losses,
                 {.loss_class = LossClass::identity,
                  .entity = g.name,
                  .what = "a member of a geological record",
                  .why = "it has no record",
                  .where = {geology_name(archive), g.line + 1},
                  .code = "F109",
                  .message =
                      g.type + " '" + g.name + "' names " + to_string(kind) + " " + std::to_string(member) + ", which has no record"});
    }
    return known;
}

struct SurfacePlaces {
    std::vector<Vec3> points;
    std::vector<Segment> edges;
};

/// The points and edges of all surfaces, ascending.
SurfacePlaces places_of(const std::vector<std::optional<GeogramMesh>>& surfaces) {
    SurfacePlaces all;
    for (const auto& mesh : surfaces) {
        all.points.insert(all.points.end(), mesh->points.begin(), mesh->points.end());
        for (std::size_t f = 0; f < mesh->facets.size(); ++f) {
            const auto corners = mesh->facets[f];
            for (std::size_t k = 0; k < corners.size(); ++k)
                all.edges.push_back(segment(mesh->points[corners[k]], mesh->points[corners[(k + 1) % corners.size()]]));
        }
    }
    std::ranges::sort(all.points);
    std::ranges::sort(all.edges);
    return all;
}

void list_attributes(const GeogramMesh& mesh, std::string_view of, Dataset& data) {
    for (const Attribute& a : mesh.attributes)
        drop(data.findings, data.losses,
             {.what = "attribute '" + a.name + "' of " + std::string(of), .why = "lines and corners of a model carry none here"});
}

/// A line or corner that is an object of its own keeps what it carries.
template <class Points>
Points object_of(GeogramMesh mesh, std::string name) {
    Points object;
    object.info.name = std::move(name);
    object.info.precision = mesh.precision;
    object.points = std::move(mesh.points);
    object.info.attributes = std::move(mesh.attributes);
    return object;
}

}  // namespace

std::vector<Interface> interfaces_of(const GmArchive& archive, Dataset& data) {
    std::vector<Interface> interfaces;
    const auto& surfaces = archive.text.entities[EntityText::surface];
    std::vector<bool> taken(surfaces.size(), false);
    for (const GeologicalText& g : archive.geology) {
        if (g.type != "Interface") continue;
        Interface& one = interfaces.emplace_back(g.name, g.feature, std::vector<std::uint32_t>{});
        for (const std::uint32_t s : known_members(archive, g, EntityText::surface, data)) {
            if (!taken[s]) one.surfaces.push_back(s);
            else
                data.findings.push_back(make_finding(
                    "F113", "Surface " + std::to_string(s) + " is a part of a second Interface, '" + g.name + "': the first one holds",
                    {geology_name(archive), g.line + 1}));
            taken[s] = true;
        }
    }
    std::erase_if(interfaces, [](const Interface& i) { return i.surfaces.empty(); });
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        if (!taken[s]) interfaces.push_back({name_or_number(surfaces[s], EntityText::surface, s), surfaces[s].feature, {s}});
    }
    for (Interface& i : interfaces) {
        if (i.feature.empty()) i.feature = surfaces[i.surfaces.front()].feature;
    }
    return interfaces;
}

void state_regions(const GmArchive& archive, std::span<const std::uint32_t> face_of_surface, StatedModel& model, Dataset& data) {
    model.name = archive.text.model;
    const auto add_region = [&](const EntityText::Entity& entity, std::string name, std::size_t number) {
        StatedModel::Region& region = model.regions.emplace_back();
        region.number = static_cast<std::int64_t>(number);
        region.name = std::move(name);
        for (const EntityText::Bound& b : entity.bounds) region.sides.push_back({face_of_surface[b.number], b.positive});
    };
    const auto& regions = archive.text.entities[EntityText::region];
    for (std::size_t r = 0; r < regions.size(); ++r) add_region(regions[r], name_or_number(regions[r], EntityText::region, r), r);
    if (archive.text.universe) {
        add_region(*archive.text.universe, "Universe", regions.size());
        model.regions.back().universe = true;
    }
    for (const GeologicalText& g : archive.geology) {
        if (g.type == "Layer") model.layers.push_back({g.name, known_members(archive, g, EntityText::region, data), {}});
        else if (g.type == "Contact" && g.name.starts_with("contact_"))
            list_dropped(data.losses, {LossClass::style, "", "names of contacts", "they follow from the interfaces that meet there"});
        else if (g.type != "Interface")
            drop(data.findings, data.losses,
                 {.loss_class = LossClass::identity,
                  .entity = g.name,
                  .what = g.type + " '" + g.name + "'",
                  .why = "only interfaces and layers are kept",
                  .where = {geology_name(archive), g.line}});
    }
}

void keep_lines_and_corners(const GmArchive& archive, Dataset& data) {
    SurfacePlaces places = places_of(archive.meshes[EntityText::surface]);
    const auto& lines = archive.meshes[EntityText::line];
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const GeogramMesh& mesh = *lines[i];
        const auto& entity = archive.text.entities[EntityText::line][i];
        const bool on_surface = std::ranges::all_of(mesh.edges, [&](const auto& e) {
            return std::ranges::binary_search(places.edges, segment(mesh.points[e[0]], mesh.points[e[1]]));
        });
        if (!on_surface) {
            auto set = object_of<PolylineSet>(mesh, name_or_number(entity, EntityText::line, i));
            set.edges = mesh.edges;
            data.objects.emplace_back(std::move(set));
            places.points.insert(places.points.end(), mesh.points.begin(), mesh.points.end());
            continue;
        }
        list_attributes(mesh, "lines", data);
        if (!entity.name.empty())
            list_dropped(data.losses, {LossClass::identity, entity.name, "the name of a line", "lines have no names here"});
    }
    std::ranges::sort(places.points);
    const auto& corners = archive.meshes[EntityText::corner];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const GeogramMesh& mesh = *corners[i];
        const auto& entity = archive.text.entities[EntityText::corner][i];
        if (std::ranges::all_of(mesh.points, [&](const Vec3& p) { return std::ranges::binary_search(places.points, p); })) {
            list_attributes(mesh, "corners", data);
            if (!entity.name.empty() && !mesh.points.empty() && !data.models.empty())
                data.models.front().corners.push_back({entity.name, mesh.points.front()});
            continue;
        }
        data.objects.emplace_back(object_of<PointSet>(mesh, name_or_number(entity, EntityText::corner, i)));
    }
}

}  // namespace geomend::ringmesh
