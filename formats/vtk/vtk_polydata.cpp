// SPDX-License-Identifier: AGPL-3.0-or-later
// PolyData datasets, meshes of cells, and our objects: which is which, both ways.
#include <algorithm>
#include <numeric>

#include "formats/vtk/vtk_cells.h"

namespace geomend::vtk {

namespace {

bool has_cell_attributes(const ObjectInfo& info) {
    return std::ranges::any_of(info.attributes, [](const Attribute& a) { return a.location == AttributeLocation::cell; });
}

void move_attributes(std::vector<Attribute>& attributes, AttributeLocation from, AttributeLocation to) {
    for (Attribute& a : attributes) {
        if (a.location == from) a.location = to;
    }
}

bool one_vertex_per_point(const CellList& verts, std::size_t points) {
    if (verts.size() != points || verts.corners.size() != points) return false;
    for (std::size_t i = 0; i < points; ++i) {
        if (verts.corners[i] != i) return false;
    }
    return true;
}

PointSet points_of(PolyData&& data) {
    PointSet set;
    set.info = std::move(data.info);
    set.points = std::move(data.points);
    return set;
}

PolylineSet lines_of(PolyData&& data) {
    PolylineSet set;
    const CellList& lines = data.lines;
    const bool single_edges = lines.corners.size() == 2 * lines.size();
    set.edges.reserve(lines.corners.size() - lines.size());
    std::vector<std::uint32_t> source;
    std::uint32_t owned = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto line = lines[i];
        if (!single_edges) set.parts.push_back({owned, set.edges.size(), {}});
        for (std::size_t k = 0; k + 1 < line.size(); ++k) {
            set.edges.push_back({line[k], line[k + 1]});
            source.push_back(static_cast<std::uint32_t>(i));
        }
        for (const std::uint32_t p : line) owned = std::max(owned, p + 1);
    }
    set.info = std::move(data.info);
    set.points = std::move(data.points);
    for (Attribute& a : set.info.attributes) {
        if (a.location != AttributeLocation::cell) continue;
        a.location = AttributeLocation::edge;
        if (single_edges) continue;
        take_values(a, source);
        a.annotations.emplace_back(std::string(attribute_per_key), "polyline");
    }
    return set;
}

// Strips come last in cell data, after the polygons.
std::vector<std::uint32_t> append_strips(const CellList& strips, std::size_t cells_before, Polygons& polygons) {
    std::vector<std::uint32_t> source(polygons.size());
    std::iota(source.begin(), source.end(), 0u);
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const auto strip = strips[i];
        for (std::size_t k = 0; k + 2 < strip.size(); ++k) {
            const std::size_t odd = k % 2;
            const std::array<std::uint32_t, 3> t{strip[k + odd], strip[k + 1 - odd], strip[k + 2]};
            polygons.push_back(t);
            source.push_back(static_cast<std::uint32_t>(cells_before + i));
        }
    }
    return source;
}

Surface surface_of(PolyData&& data) {
    Surface surface;
    const bool triangles = data.polys.corners.size() == 3 * data.polys.size();
    bool all_three = triangles;
    for (std::size_t i = 0; all_three && i < data.polys.size(); ++i) all_three = data.polys.offsets[i + 1] == 3 * (i + 1);
    const std::size_t polys = data.polys.size();
    surface.polygons.corners = std::move(data.polys.corners);
    if (!all_three) surface.polygons.offsets = std::move(data.polys.offsets);
    surface.info = std::move(data.info);
    if (data.strips.size() != 0) {
        const auto source = append_strips(data.strips, polys, surface.polygons);
        for (Attribute& a : surface.info.attributes) {
            if (a.location == AttributeLocation::cell) take_values(a, source);
        }
    }
    move_attributes(surface.info.attributes, AttributeLocation::cell, AttributeLocation::polygon);
    surface.points = std::move(data.points);
    return surface;
}

CellType polygon_type(std::size_t corners) { return corners == 3 ? CellType::triangle : corners == 4 ? CellType::quad : CellType::polygon; }

CellMesh mixed_mesh(PolyData&& data) {
    CellMesh mesh;
    MeshBuilder builder(mesh);
    // Cells that are too short to be of their kind stand as what their points make of them.
    const auto add = [&](std::span<const std::uint32_t> cell, CellType type) {
        if (cell.empty()) return builder.add(0, cell);
        if (cell.size() == 1) type = CellType::vertex;
        else if (cell.size() == 2 && dimension(type) == 2) type = CellType::line;
        return builder.add(static_cast<int>(type), cell);
    };
    for (std::size_t i = 0; i < data.verts.size(); ++i) add(data.verts[i], CellType::poly_vertex);
    for (std::size_t i = 0; i < data.lines.size(); ++i)
        add(data.lines[i], data.lines[i].size() == 2 ? CellType::line : CellType::poly_line);
    for (std::size_t i = 0; i < data.polys.size(); ++i) add(data.polys[i], polygon_type(data.polys[i].size()));
    for (std::size_t i = 0; i < data.strips.size(); ++i) {
        if (data.strips[i].size() < 3) add(data.strips[i], CellType::line);
        else builder.add(6, data.strips[i]);
    }
    mesh.info = std::move(data.info);
    builder.fit(mesh.info.attributes);
    mesh.points = std::move(data.points);
    return mesh;
}

bool sizes_at_least(const CellList& cells, std::size_t least) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].size() < least) return false;
    }
    return true;
}

Object choose(PolyData&& data) {
    const std::size_t verts = data.verts.size(), lines = data.lines.size(), areas = data.polys.size() + data.strips.size();
    if (lines == 0 && areas == 0) {
        const bool plain = verts == 0 || one_vertex_per_point(data.verts, data.points.size());
        if (plain && !has_cell_attributes(data.info)) return points_of(std::move(data));
    } else if (verts == 0 && areas == 0) {
        if (sizes_at_least(data.lines, 2)) return lines_of(std::move(data));
    } else if (verts == 0 && lines == 0) {
        if (sizes_at_least(data.polys, 3) && sizes_at_least(data.strips, 3)) return surface_of(std::move(data));
    }
    return mixed_mesh(std::move(data));
}

std::uint64_t part_end(const PolylineSet& set, std::size_t part) {
    return part + 1 < set.parts.size() ? set.parts[part + 1].first_edge : set.edges.size();
}

void chain_edges(const PolylineSet& set, std::uint64_t first, std::uint64_t last, CellList& lines, std::vector<std::uint64_t>& first_edge) {
    std::uint64_t at = first;
    while (at < last) {
        first_edge.push_back(at);
        lines.corners.push_back(set.edges[at][0]);
        do lines.corners.push_back(set.edges[at++][1]);
        while (at < last && set.edges[at][0] == set.edges[at - 1][1]);
        lines.offsets.push_back(lines.corners.size());
    }
}

void add_all(CellMesh& mesh, const CellList& cells, CellType few, CellType many, std::size_t few_size) {
    for (std::size_t i = 0; i < cells.size(); ++i) mesh.add_cell(cells[i].size() == few_size ? few : many, cells[i]);
}

// Values per edge become values per line where they are the same along it, which `attribute_per_key` states.
void edges_to_lines(std::vector<Attribute>& attributes, const std::vector<std::uint64_t>& first_edge) {
    std::vector<std::uint32_t> source(first_edge.size());
    for (std::size_t i = 0; i < source.size(); ++i) source[i] = static_cast<std::uint32_t>(first_edge[i]);
    for (Attribute& a : attributes) {
        if (a.location != AttributeLocation::edge) continue;
        take_values(a, source);
        std::erase_if(a.annotations, [](const auto& pair) { return pair.first == attribute_per_key; });
        a.location = AttributeLocation::cell;
    }
}

// Whether every edge attribute is one per polyline, so that lines may be chained; else each edge is its own line.
bool chains_keep_values(const PolylineSet& set) {
    return std::ranges::all_of(set.info.attributes, [](const Attribute& a) {
        if (a.location != AttributeLocation::edge) return true;
        return std::ranges::any_of(a.annotations, [](const auto& pair) { return pair.first == attribute_per_key; });
    });
}

CellList lines_for_writing(const PolylineSet& set, std::vector<std::uint64_t>& first_edge) {
    if (!set.parts.empty() && chains_keep_values(set)) return polylines_of(set, first_edge);
    CellList lines;
    for (std::size_t i = 0; i < set.edges.size(); ++i) {
        lines.add(set.edges[i]);
        first_edge.push_back(i);
    }
    return lines;
}

bool polydata_from_mesh(const CellMesh& mesh, PolyData& data) {
    // PolyData orders its cells by kind: cell attributes follow, so the order is kept as a permutation.
    std::array<CellList*, 3> lists{&data.verts, &data.lines, &data.polys};
    std::array<std::vector<std::uint32_t>, 3> order;
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        const CellType type = mesh.types[i];
        if (is_second_order(type) || dimension(type) > 2) return false;
        const auto kind = static_cast<std::size_t>(dimension(type));
        lists[kind]->add(mesh.cell_nodes(i));
        order[kind].push_back(static_cast<std::uint32_t>(i));
    }
    for (std::size_t kind = 1; kind < 3; ++kind) order[0].insert(order[0].end(), order[kind].begin(), order[kind].end());
    data.info = mesh.info;
    data.points = mesh.points;
    if (!std::ranges::is_sorted(order[0])) {
        for (Attribute& a : data.info.attributes) {
            if (a.location == AttributeLocation::cell) take_values(a, order[0]);
        }
    }
    return true;
}

CellList list_of(const Polygons& polygons) {
    CellList list;
    list.corners = polygons.corners;
    list.offsets = polygons.offsets;
    if (polygons.all_triangles()) {
        list.offsets.resize(polygons.size() + 1);
        for (std::size_t i = 0; i <= polygons.size(); ++i) list.offsets[i] = 3 * i;
    }
    return list;
}

}  // namespace

Object object_from_polydata(PolyData data) {
    Object object = choose(std::move(data));
    ObjectInfo& info = info_of(object);
    std::erase_if(info.annotations, [](const Annotation& a) { return a.key == dataset_key; });
    info.annotations.push_back({std::string(dataset_key), "PolyData"});
    return object;
}

CellList polylines_of(const PolylineSet& set, std::vector<std::uint64_t>& first_edge) {
    CellList lines;
    lines.corners.reserve(set.edges.size() + set.parts.size());
    if (set.parts.empty()) chain_edges(set, 0, set.edges.size(), lines, first_edge);
    for (std::size_t part = 0; part < set.parts.size(); ++part)
        chain_edges(set, set.parts[part].first_edge, part_end(set, part), lines, first_edge);
    return lines;
}

bool polydata_from_object(const Object& object, PolyData& data) {
    if (const auto* mesh = std::get_if<CellMesh>(&object)) return polydata_from_mesh(*mesh, data);
    if (const auto* set = std::get_if<PointSet>(&object)) {
        data.points = set->points;
        for (std::uint32_t i = 0; i < set->points.size(); ++i) data.verts.add({&i, 1});
    } else if (const auto* polylines = std::get_if<PolylineSet>(&object)) {
        std::vector<std::uint64_t> first_edge;
        data.points = polylines->points;
        data.lines = lines_for_writing(*polylines, first_edge);
        data.info = polylines->info;
        edges_to_lines(data.info.attributes, first_edge);
        return true;
    } else if (const auto* surface = std::get_if<Surface>(&object)) {
        data.points = surface->points;
        data.polys = list_of(surface->polygons);
    } else {
        return false;
    }
    data.info = info_of(object);
    move_attributes(data.info.attributes, AttributeLocation::polygon, AttributeLocation::cell);
    return true;
}

bool mesh_from_object(const Object& object, CellMesh& mesh) {
    if (const auto* own = std::get_if<CellMesh>(&object)) {
        mesh = *own;
        return true;
    }
    PolyData data;
    if (!polydata_from_object(object, data)) return false;
    add_all(mesh, data.verts, CellType::vertex, CellType::poly_vertex, 1);
    add_all(mesh, data.lines, CellType::line, CellType::poly_line, 2);
    for (std::size_t i = 0; i < data.polys.size(); ++i) mesh.add_cell(polygon_type(data.polys[i].size()), data.polys[i]);
    mesh.info = std::move(data.info);
    mesh.points = std::move(data.points);
    return true;
}

Object object_of_kind(CellMesh mesh, std::string_view kind) {
    const int wanted = kind == "point-set" ? 0 : kind == "polyline-set" ? 1 : kind == "surface" ? 2 : -1;
    if (wanted < 0) return mesh;
    const bool fits = std::ranges::all_of(mesh.types, [&](CellType type) { return dimension(type) == wanted && !is_second_order(type); });
    PolyData data;
    if (!fits || !polydata_from_mesh(mesh, data)) return mesh;
    Object object = choose(std::move(data));
    if (kind_name(object) != kind) return mesh;
    return object;
}

}  // namespace geomend::vtk
