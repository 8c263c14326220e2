// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "topology/faces_from_surfaces.h"
#include "topology/front_ends.h"
#include "topology/mesh_parts.h"

namespace geomend::topology {

namespace {

/// True for polygons that share next to no points, although more than a quarter are at positions of others, as STL files have it.
bool is_soup(const BrepData::Surface& surface) {
    const std::size_t corners = surface.polygons.corners.size();
    if (surface.polygons.size() < 2 || 10 * surface.nodes.size() < 9 * corners) return false;
    std::vector<VertexId> vertices = surface.nodes;
    std::sort(vertices.begin(), vertices.end());
    const auto distinct = static_cast<std::size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
    return 4 * distinct < 3 * surface.nodes.size();  // two triangles side by side have four positions
}

/// One node for each vertex; attributes go, since they may differ.
void join_nodes(BrepData::Surface& surface) {
    std::vector<VertexId> nodes = surface.nodes;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (std::uint32_t& corner : surface.polygons.corners) {
        corner = static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), surface.nodes[corner]) - nodes.begin());
    }
    surface.nodes = std::move(nodes);
    surface.attributes.clear();
}

/// Names a surface whose polygons had points of their own.
void report_soup(SurfaceComplex& complex, const SurfaceComplex::Face& face) {
    Finding finding = make_finding(
        "M08", "the triangles of '" + face.interface_name + "' have points of their own: judged as joined where points are equal", {}, 0);
    finding.entities.push_back({"interface", face.interface_name, -1});
    finding.count = face.surface.polygons.size();
    finding.element_kind = "triangle";
    complex.findings.push_back(std::move(finding));
}

/// Where a face comes from: a part of a surface, or cells of a mesh.
struct Place {
    std::uint32_t object, part;
    std::optional<MeshSurface> cells;  ///< of a mesh; or polygons of a surface that an array tells apart
};

SurfaceComplex::Face face_at(const Dataset& dataset, const Place& place, const WeldedPoints& points) {
    if (const auto* mesh = std::get_if<CellMesh>(&dataset.objects[place.object]))
        return face_of_cells(*mesh, place.object, *place.cells, points);
    const auto& surface = std::get<Surface>(dataset.objects[place.object]);
    if (place.cells) {
        SurfaceComplex::Face face = face_of_polygons(surface, place.object, place.cells->cells, points);
        face.surface.source_part = place.cells->part;
        face.interface_name = place.cells->name;
        return face;
    }
    SurfaceComplex::Face face = face_of_part(surface, place.object, place.part, points);
    face.interface_name = surface.info.name;
    face.surface.role = surface.info.role;
    face.surface.role_text = surface.info.role_text;
    return face;
}

/// All faces of some objects; what is said of lines and of whole interfaces goes into the complex.
std::vector<Place> places_of(const Dataset& dataset, std::span<const std::uint32_t> objects, const WeldedPoints& points, Arrays arrays,
                             SurfaceComplex& complex) {
    std::vector<Place> places;
    std::set<std::string> known;
    for (const std::uint32_t o : objects) {
        if (const auto* mesh = std::get_if<CellMesh>(&dataset.objects[o])) {
            for (MeshSurface& cells : surfaces_of_mesh(*mesh)) places.push_back({o, 0, std::move(cells)});
            add_lines_of_mesh(parts_of_mesh(*mesh, o), points, complex);
            continue;
        }
        const auto& surface = std::get<Surface>(dataset.objects[o]);
        auto by_array = arrays == Arrays::tell_apart ? surfaces_by_array(surface) : std::vector<MeshSurface>();
        for (MeshSurface& one : by_array) places.push_back({o, 0, std::move(one)});
        if (!by_array.empty()) continue;
        for (std::uint32_t part = 0; part < part_count(surface); ++part) places.push_back({o, part, std::nullopt});
        add_corner_hints(dataset.objects[o], points.of.at(o), complex);
        if (known.insert(surface.info.name).second) {
            complex.interfaces.push_back({surface.info.name, surface.info.feature, surface.info.annotations});
        }
    }
    return places;
}

}  // namespace

SurfaceComplex complex_of_loose_surfaces(const Dataset& dataset, std::span<const WeldGroup> groups, Arrays arrays) {
    std::vector<std::uint32_t> objects;
    for (const WeldGroup& group : groups) objects.insert(objects.end(), group.objects.begin(), group.objects.end());
    std::ranges::sort(objects);
    WeldedPoints points = weld_points(dataset, groups);
    SurfaceComplex complex;
    complex.name = info_of(dataset.objects[objects.front()]).name;
    complex.crs = info_of(dataset.objects[objects.front()]).crs;
    complex.stated = false;
    complex.take_apart = true;
    complex.lines.shared_nodes = true;  // a fault that ends inside a horizon seldom cuts it there
    const std::vector<Place> places = places_of(dataset, objects, points, arrays, complex);
    complex.faces.resize(places.size());
    std::vector<std::uint8_t> joined(places.size(), 0);
    parallel_for_each_index(places.size(), [&](std::size_t f) {
        auto& face = complex.faces[f];
        face = face_at(dataset, places[f], points);
        if (!is_soup(face.surface)) return;
        join_nodes(face.surface);
        joined[f] = 1;
    });
    for (std::size_t f = 0; f < joined.size(); ++f) {
        if (joined[f] != 0) report_soup(complex, complex.faces[f]);
    }
    give_vertices(points, complex);
    return complex;
}

}  // namespace geomend::topology
