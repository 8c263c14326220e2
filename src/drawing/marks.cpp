// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "drawing/parts.h"
#include "drawing/scene.h"

namespace geomend {

namespace {

// Which elements of its first entity a finding lists.
bool is_kind(const Finding& f, std::initializer_list<std::string_view> kinds) {
    const std::string_view kind = std::string_view(f.element_kind).substr(0, f.element_kind.find('-'));
    return std::ranges::find(kinds, kind) != kinds.end();
}
bool lists_points(const Finding& f) { return is_kind(f, {"point", "node", "vertex"}); }
bool lists_polygons(const Finding& f) { return is_kind(f, {"triangle", "polygon", "quad", "face", "element"}); }
bool lists_edges(const Finding& f) { return is_kind(f, {"edge", "segment"}); }
bool lists_cells(const Finding& f) {
    return is_kind(f, {"cell", "element", "tetrahedron", "polyhedron", "hexahedron", "wedge", "pyramid"});
}

// Calls use(i) for each index below `size`.
template <class Use>
void each_index(const Finding& f, std::size_t size, const Use& use) {
    for (const std::int64_t i : f.index) {
        if (i >= 0 && static_cast<std::uint64_t>(i) < size) use(static_cast<std::size_t>(i));
    }
}

// A polygon as triangles and outline; position(corner) gives its places.
template <class Position>
void mark_polygon(std::span<const std::uint32_t> polygon, const Position& position, SceneMark& mark) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    scene::add_fan(polygon, triangles);
    for (const auto& [a, b, c] : triangles) mark.triangles.push_back({position(a), position(b), position(c)});
    std::vector<Vec3> outline;
    for (const std::uint32_t n : polygon) outline.push_back(position(n));
    if (!outline.empty()) outline.push_back(outline.front());
    mark.outlines.push_back(std::move(outline));
}

// ---- corner-point grids

void mark_box(const std::array<Vec3, 8>& corners, SceneMark& mark) {
    if (!scene::is_finite(corners)) return;
    constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
    for (const auto& [a, b, c, d] : sides) {
        mark.triangles.push_back({corners[a], corners[b], corners[c]});
        mark.triangles.push_back({corners[a], corners[c], corners[d]});
    }
    for (const unsigned base : {0u, 4u})
        mark.outlines.push_back({corners[base], corners[base + 1], corners[base + 3], corners[base + 2], corners[base]});
    for (unsigned c = 0; c < 4; ++c) mark.outlines.push_back({corners[c], corners[c + 4]});
}

// A column of cells from its uppermost to its lowest finite corners.
void mark_column(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, SceneMark& mark) {
    std::array<Vec3, 8> box{};
    bool any = false;
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        const auto corners = scene::elevated_corners(grid, i, j, k);
        if (!scene::is_finite(corners)) continue;
        if (!any) box = corners;
        any = true;
        std::copy(corners.begin() + 4, corners.end(), box.begin() + 4);
    }
    if (any) mark_box(box, mark);
}

// A pillar over the depths that the cells around it have on it.
void mark_pillar(const CornerPointGrid& grid, std::size_t pillar, SceneMark& mark) {
    const std::size_t lines = std::size_t{grid.dims[0]} + 1, in_set = pillar % pillar_count(grid.dims);
    const double* values = grid.pillars.data() + 6 * pillar;
    double upper = std::numeric_limits<double>::infinity(), lower = -upper;
    for (unsigned c = 0; c < 4; ++c) {
        const std::size_t i = in_set % lines - (c & 1u), j = in_set / lines - (c >> 1);
        if (i >= grid.dims[0] || j >= grid.dims[1]) continue;  // also where it went below 0
        for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
            for (const unsigned corner : {c, c + 4}) {
                const double depth = grid.depths[corner_index(grid.dims, i, j, k, corner)];
                if (!(std::abs(depth) < 1e20)) continue;
                upper = std::min(upper, depth);
                lower = std::max(lower, depth);
            }
        }
    }
    if (upper > lower) return;
    Vec3 top = pillar_point(values, upper, grid.cylindrical), base = pillar_point(values, lower, grid.cylindrical);
    top[2] = -top[2];
    base[2] = -base[2];
    if (top == base) mark.points.push_back(top);
    else mark.polylines.push_back({top, base});
}

void mark_elements(const CornerPointGrid& grid, const Finding& f, SceneMark& mark) {
    if (grid.depths.empty() || !misfit(grid).empty()) return;
    const std::size_t columns = std::size_t{grid.dims[0]} * grid.dims[1];
    if (is_kind(f, {"cell"})) {
        each_index(f, grid.cell_count(), [&](std::size_t cell) {
            const auto [i, j, k] = grid.ijk(cell);
            mark_box(scene::elevated_corners(grid, i, j, k), mark);
        });
    } else if (is_kind(f, {"column"})) {
        each_index(f, columns, [&](std::size_t c) {
            mark_column(grid, static_cast<std::uint32_t>(c % grid.dims[0]), static_cast<std::uint32_t>(c / grid.dims[0]), mark);
        });
    } else if (is_kind(f, {"pillar"})) {
        each_index(f, grid.pillars.size() / 6, [&](std::size_t p) { mark_pillar(grid, p, mark); });
    }
}

// ---- other objects

void mark_elements(const Surface& o, const Finding& f, SceneMark& mark) {
    if (lists_points(f)) each_index(f, o.points.size(), [&](std::size_t i) { mark.points.push_back(o.points[i]); });
    else if (lists_polygons(f) || f.element_kind.empty())
        each_index(f, o.polygons.size(), [&](std::size_t i) {
            mark_polygon(
                o.polygons[i], [&](std::uint32_t n) { return o.points[n]; }, mark);
        });
}

void mark_elements(const PolylineSet& o, const Finding& f, SceneMark& mark) {
    if (lists_points(f)) each_index(f, o.points.size(), [&](std::size_t i) { mark.points.push_back(o.points[i]); });
    else if (lists_edges(f))
        each_index(f, o.edges.size(), [&](std::size_t i) { mark.polylines.push_back({o.points[o.edges[i][0]], o.points[o.edges[i][1]]}); });
}

void mark_elements(const PointSet& o, const Finding& f, SceneMark& mark) {
    each_index(f, o.points.size(), [&](std::size_t i) { mark.points.push_back(o.points[i]); });
}

void mark_elements(const CellMesh& o, const Finding& f, SceneMark& mark) {
    const auto position = [&](std::uint32_t n) { return o.points[n]; };
    if (lists_points(f)) each_index(f, o.points.size(), [&](std::size_t i) { mark.points.push_back(o.points[i]); });
    else if (lists_cells(f) || lists_polygons(f))
        each_index(f, o.cell_count(), [&](std::size_t cell) {
            const auto faces = scene::faces_of_cell(o, cell);
            for (const auto& face : faces) mark_polygon(face, position, mark);
            if (faces.empty() && dimension(o.types[cell]) == 2) mark_polygon(o.cell_nodes(cell), position, mark);
            if (dimension(o.types[cell]) < 2)
                for (const std::uint32_t n : o.cell_nodes(cell)) mark.points.push_back(position(n));
        });
}

void mark_elements(const StructuredGrid& o, const Finding& f, SceneMark& mark) {
    if (lists_points(f)) return each_index(f, o.points.size(), [&](std::size_t i) { mark.points.push_back(o.points[i]); });
    if (!is_kind(f, {"cell"}) || o.points.size() != sample_count(o.dims)) return;
    std::array<std::uint64_t, 3> cells{};
    for (std::size_t a = 0; a < 3; ++a) cells[a] = std::max(1u, o.dims[a] - 1);
    each_index(f, cells[0] * cells[1] * cells[2], [&](std::size_t cell) {
        std::array<Vec3, 8> corners{};
        const std::array<std::size_t, 3> at{cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]};
        for (unsigned c = 0; c < 8; ++c) {
            std::array<std::size_t, 3> n{};
            for (unsigned a = 0; a < 3; ++a) n[a] = std::min<std::size_t>(at[a] + (c >> a & 1u), o.dims[a] - 1);
            corners[c] = o.points[n[0] + o.dims[0] * (n[1] + std::size_t{o.dims[1]} * n[2])];
        }
        mark_box(corners, mark);
    });
}

void mark_elements(const Well& o, const Finding& f, SceneMark& mark) {
    each_index(f, o.path.size(), [&](std::size_t i) { mark.points.push_back(o.path[i]); });
}

void mark_elements(const Raster& o, const Finding& f, SceneMark& mark) {
    if (!lists_points(f)) return;
    each_index(f, sample_count(o.dims), [&](std::size_t s) {
        const auto i = static_cast<std::uint32_t>(s % o.dims[0]), j = static_cast<std::uint32_t>(s / o.dims[0] % o.dims[1]);
        Vec3 p = sample_position(o, i, j, static_cast<std::uint32_t>(s / o.dims[0] / o.dims[1]));
        if (o.height_attribute < o.info.attributes.size()) p[2] = value_as_double(o.info.attributes[o.height_attribute], s);
        if (std::isfinite(p[2])) mark.points.push_back(p);
    });
}

// ---- B-Reps

std::vector<Vec3> line_points(const BrepData& brep, std::size_t line) {
    std::vector<Vec3> points;
    for (const VertexId v : brep.lines[line].vertices) points.push_back(brep.vertices[v.value]);
    return points;
}

// Borders of a surface, as hints where nothing finer is known.
void outline_surface(const BrepData& brep, std::size_t s, SceneMark& mark) {
    for (const auto& l : brep.surfaces[s].lines) mark.outlines.push_back(line_points(brep, l.line.value));
}

// Whole lines, surfaces and regions among the elements of a finding, by their numbers in the B-Rep.
void mark_entities(const BrepData& brep, const Finding& f, SceneMark& mark) {
    if (is_kind(f, {"line"})) each_index(f, brep.lines.size(), [&](std::size_t l) { mark.polylines.push_back(line_points(brep, l)); });
    else if (is_kind(f, {"corner"}))
        each_index(f, brep.corners.size(), [&](std::size_t c) { mark.points.push_back(brep.vertices[brep.corners[c].vertex.value]); });
    else if (is_kind(f, {"surface"})) each_index(f, brep.surfaces.size(), [&](std::size_t s) { outline_surface(brep, s, mark); });
    else if (is_kind(f, {"region"}))
        each_index(f, brep.regions.size(), [&](std::size_t r) {
            for (const auto& side : brep.regions[r].sides) outline_surface(brep, side.surface.value, mark);
        });
}

void mark_surface(const BrepData& brep, std::size_t s, const Finding& f, SceneMark& mark) {
    const auto& surface = brep.surfaces[s];
    const auto position = [&](std::uint32_t n) { return brep.vertices[surface.nodes[n].value]; };
    if (lists_points(f))
        each_index(f, surface.nodes.size(), [&](std::size_t n) { mark.points.push_back(position(static_cast<std::uint32_t>(n))); });
    else if (lists_polygons(f) || f.element_kind.empty())
        each_index(f, surface.polygons.size(), [&](std::size_t p) { mark_polygon(surface.polygons[p], position, mark); });
    else mark_entities(brep, f, mark);
}

void mark_line(const BrepData& brep, std::size_t l, const Finding& f, SceneMark& mark) {
    const auto points = line_points(brep, l);
    if (lists_points(f)) each_index(f, points.size(), [&](std::size_t i) { mark.points.push_back(points[i]); });
    else if (lists_edges(f) && points.size() > 1)
        each_index(f, points.size() - 1, [&](std::size_t i) { mark.polylines.push_back({points[i], points[i + 1]}); });
    else if (mark.points.empty() && mark.polylines.empty()) mark.polylines.push_back(points);
}

void mark_region(const BrepData& brep, std::size_t r, const Finding& f, SceneMark& mark) {
    const auto& region = brep.regions[r];
    if (!lists_cells(f) || region.cell_types.empty()) return mark_entities(brep, f, mark);
    CellMesh cells;
    for (const VertexId v : region.nodes) cells.points.push_back(brep.vertices[v.value]);
    cells.types = region.cell_types;
    cells.offsets = region.cell_offsets;
    cells.nodes = region.cell_nodes;
    cells.cell_faces = region.cell_faces;
    cells.face_offsets = region.face_offsets;
    cells.face_nodes = region.face_nodes;
    mark_elements(cells, f, mark);
}

// The number of an entity among things that have names: its id where that has its name, else the first of that name.
template <class Named>
std::size_t find_entity(const std::vector<Named>& all, const EntityRef& e) {
    if (e.id >= 0 && static_cast<std::uint64_t>(e.id) < all.size() && all[static_cast<std::size_t>(e.id)].name == e.name)
        return static_cast<std::size_t>(e.id);
    return static_cast<std::size_t>(std::ranges::find(all, e.name, &Named::name) - all.begin());
}

bool mark_in(const BrepData& brep, const EntityRef& e, const Finding& f, SceneMark& mark) {
    const auto use = [&](const auto& all, const auto& mark_one) {
        const std::size_t at = find_entity(all, e);
        if (at < all.size()) mark_one(brep, at, f, mark);
        return at < all.size();
    };
    if (e.kind == "surface") return use(brep.surfaces, mark_surface);
    if (e.kind == "line") return use(brep.lines, mark_line);
    if (e.kind == "region") return use(brep.regions, mark_region);
    if (e.kind != "corner") return false;
    return use(brep.corners, [](const BrepData& b, std::size_t c, const Finding&, SceneMark& m) {
        if (m.points.empty()) m.points.push_back(b.vertices[b.corners[c].vertex.value]);
    });
}

bool mark_object(const Dataset& dataset, const EntityRef& e, const Finding& f, SceneMark& mark) {
    const Object* found = nullptr;
    for (const Object& object : dataset.objects) {
        if (info_of(object).name != e.name || e.kind != kind_name(object)) continue;
        if (found == nullptr) found = &object;
    }
    if (found != nullptr) std::visit([&](const auto& o) { mark_elements(o, f, mark); }, *found);
    return found != nullptr;
}

SceneMark mark_of(const Dataset& dataset, std::span<const Brep> breps, const Finding& f) {
    SceneMark mark;
    mark.points = f.points;
    mark.polylines = f.polylines;
    const EntityRef* first = f.entities.empty() ? nullptr : &f.entities.front();
    if (first != nullptr) {
        for (const Brep& brep : breps) {
            if (mark_in(*brep, *first, f, mark)) return mark;
        }
        if (mark_object(dataset, *first, f, mark)) return mark;
    }
    if (breps.size() == 1) mark_entities(*breps.front(), f, mark);
    return mark;
}

}  // namespace

void mark_findings(Scene& scene, const Dataset& dataset, std::span<const Brep> breps, std::span<const Finding> findings) {
    scene.marks.clear();
    for (const Finding& f : findings) scene.marks.push_back(mark_of(dataset, breps, f));
    if (scene.parts.empty()) finish(scene);
}

}  // namespace geomend
