// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/parts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "model/cell_faces.h"

namespace geomend::scene {

namespace {

ScenePart part_of(const ObjectInfo& info, const char* kind) {
    ScenePart part;
    part.kind = kind;
    part.name = info.name;
    part.role = info.role;
    return part;
}

void add_polygons(const Polygons& polygons, ScenePart& part) {
    if (polygons.all_triangles()) part.triangles.reserve(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) add_fan(polygons[i], part.triangles);
}

void add_object(const PointSet& o, std::vector<ScenePart>& parts) {
    parts.push_back(part_of(o.info, "point-set"));
    parts.back().points = o.points;
}

// Edges as lines as long as they go on from one to the next.
void add_object(const PolylineSet& o, std::vector<ScenePart>& parts) {
    ScenePart part = part_of(o.info, "polyline-set");
    part.points = o.points;
    for (const auto& [from, to] : o.edges) {
        if (part.polylines.empty() || part.polylines.back().back() != from) part.polylines.push_back({from});
        part.polylines.back().push_back(to);
    }
    parts.push_back(std::move(part));
}

void add_object(const Surface& o, std::vector<ScenePart>& parts) {
    ScenePart part = part_of(o.info, "surface");
    part.points = o.points;
    add_polygons(o.polygons, part);
    parts.push_back(std::move(part));
}

void add_object(const Well& o, std::vector<ScenePart>& parts) {
    ScenePart part = part_of(o.info, "well");
    part.points = o.path;
    if (o.path.size() > 1) {
        part.polylines.emplace_back(o.path.size());
        for (std::uint32_t i = 0; i < o.path.size(); ++i) part.polylines[0][i] = i;
    }
    parts.push_back(std::move(part));
}

// One sheet of a lattice of nodes: `number(a, b)` is the point there.
template <class Number>
void add_sheet(std::uint32_t na, std::uint32_t nb, const Number& number, ScenePart& part) {
    for (std::uint32_t b = 0; b + 1 < nb; ++b) {
        for (std::uint32_t a = 0; a + 1 < na; ++a) {
            const std::array<std::uint32_t, 4> quad{number(a, b), number(a + 1, b), number(a + 1, b + 1), number(a, b + 1)};
            if (std::ranges::none_of(quad, [](std::uint32_t n) { return n == no_index; })) add_fan(quad, part.triangles);
        }
    }
}

// The sides of a lattice, as sheets over its points.
void add_lattice_sides(const std::array<std::uint32_t, 3>& dims, ScenePart& part) {
    const auto number = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return static_cast<std::uint32_t>(i + std::size_t{dims[0]} * (j + std::size_t{dims[1]} * k));
    };
    for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const std::uint32_t end : {0u, dims[axis] - 1}) {
            if (end == 0 || dims[axis] > 1) {
                add_sheet(
                    dims[u], dims[v],
                    [&](std::uint32_t a, std::uint32_t b) {
                        std::array<std::uint32_t, 3> at{};
                        at[axis] = end;
                        at[u] = a;
                        at[v] = b;
                        return number(at[0], at[1], at[2]);
                    },
                    part);
            }
            if (dims[axis] == 1) break;
        }
    }
}

void add_object(const StructuredGrid& o, std::vector<ScenePart>& parts) {
    if (o.points.size() != sample_count(o.dims) || o.points.size() >= no_index) return;
    ScenePart part = part_of(o.info, "structured-grid");
    part.points = o.points;
    add_lattice_sides(o.dims, part);
    parts.push_back(std::move(part));
}

// Only the points that are used stay.
void drop_unused(ScenePart& part) {
    std::vector<std::uint32_t> becomes(part.points.size(), no_index);
    std::vector<Vec3> points;
    const auto use = [&](std::uint32_t& n) {
        if (becomes[n] == no_index) {
            becomes[n] = static_cast<std::uint32_t>(points.size());
            points.push_back(part.points[n]);
        }
        n = becomes[n];
    };
    for (auto& triangle : part.triangles) std::ranges::for_each(triangle, use);
    for (auto& line : part.polylines) std::ranges::for_each(line, use);
    part.points = std::move(points);
}

// Samples of one height each become a surface, with holes where there is no data.
void add_object(const Raster& o, std::vector<ScenePart>& parts) {
    if (sample_count(o.dims) >= no_index) return;
    ScenePart part = part_of(o.info, "raster");
    const Attribute* height = o.height_attribute < o.info.attributes.size() ? &o.info.attributes[o.height_attribute] : nullptr;
    std::vector<std::uint8_t> missing;
    for (std::uint32_t k = 0; k < o.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < o.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < o.dims[0]; ++i) {
                Vec3 p = sample_position(o, i, j, k);
                const double z = height == nullptr ? 0 : value_as_double(*height, part.points.size());
                const bool none = height != nullptr && (!std::isfinite(z) || is_no_data(*height, z));
                if (height != nullptr && !none) p[2] = z;
                part.points.push_back(p);
                missing.push_back(none ? 1 : 0);
            }
        }
    }
    add_lattice_sides(o.dims, part);
    std::erase_if(part.triangles, [&](const auto& t) { return missing[t[0]] + missing[t[1]] + missing[t[2]] > 0; });
    if (!part.triangles.empty()) drop_unused(part);
    parts.push_back(std::move(part));
}

std::uint64_t mixed(std::uint64_t h) {
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 27) * 0x94d049bb133111ebu;
    return h ^ h >> 31;
}

// Faces of cells that no other cell has, told by a number made of their nodes in any order.
std::vector<std::vector<std::uint32_t>> outer_faces(const CellMesh& mesh) {
    struct Face {
        std::uint64_t key;
        std::uint32_t cell, face;
    };
    std::vector<Face> all;
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
        const auto faces = faces_of_cell(mesh, c);
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            std::uint64_t key = faces[f].size();
            for (const std::uint32_t n : faces[f]) key += mixed(n + 1);
            all.push_back({key, c, f});
        }
    }
    std::ranges::sort(all, {}, [](const Face& f) { return std::tuple(f.key, f.cell, f.face); });
    std::vector<std::vector<std::uint32_t>> outer;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool shared = (i > 0 && all[i - 1].key == all[i].key) || (i + 1 < all.size() && all[i + 1].key == all[i].key);
        if (!shared) outer.push_back(faces_of_cell(mesh, all[i].cell)[all[i].face]);
    }
    return outer;
}

// The part of each entity of a dimension; one for cells without.
std::vector<ScenePart> parts_of_entities(const CellMesh& mesh, int wanted) {
    std::vector<ScenePart> parts(mesh.entities.size() + 1);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (dimension(mesh.types[c]) != wanted) continue;
        const std::uint32_t entity = c < mesh.cell_entity.size() ? mesh.cell_entity[c] : no_index;
        ScenePart& part = parts[entity < mesh.entities.size() ? entity : mesh.entities.size()];
        const auto nodes = mesh.cell_nodes(c);
        const std::uint32_t corners = node_count(linear_type(mesh.types[c]));
        const auto used = corners == 0 || corners > nodes.size() ? nodes : nodes.first(corners);
        if (wanted == 2) add_fan(used, part.triangles);
        else part.polylines.emplace_back(used.begin(), used.end());
    }
    for (std::size_t e = 0; e < parts.size(); ++e) {
        const bool of_entity = e < mesh.entities.size();
        parts[e].kind = of_entity ? (wanted == 2 ? "surface" : "line") : "cell-mesh";
        parts[e].name = of_entity ? mesh.entities[e].name : mesh.info.name;
        parts[e].role = of_entity ? mesh.entities[e].role : mesh.info.role;
    }
    return parts;
}

void add_object(const CellMesh& mesh, std::vector<ScenePart>& parts) {
    std::array<bool, 4> has{};
    for (const CellType type : mesh.types) has[static_cast<std::size_t>(dimension(type))] = true;
    std::vector<ScenePart> own;
    if (has[2]) own = parts_of_entities(mesh, 2);
    else if (has[3]) {
        own.push_back(part_of(mesh.info, "cell-mesh"));
        for (const auto& face : outer_faces(mesh)) add_fan(face, own[0].triangles);
    } else if (has[1]) own = parts_of_entities(mesh, 1);
    for (ScenePart& part : own) {
        if (part.triangles.empty() && part.polylines.empty()) continue;
        part.points = mesh.points;
        drop_unused(part);
        parts.push_back(std::move(part));
    }
    if (has[1] || has[2] || has[3]) return;
    parts.push_back(part_of(mesh.info, "cell-mesh"));
    parts.back().points = mesh.points;
}

void add_object(const CornerPointGrid& grid, std::vector<ScenePart>& parts) { add_parts(grid, parts); }

}  // namespace

void add_fan(std::span<const std::uint32_t> polygon, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
}

std::vector<std::vector<std::uint32_t>> faces_of_cell(const CellMesh& mesh, std::size_t cell) {
    std::vector<std::vector<std::uint32_t>> faces;
    if (mesh.types[cell] == CellType::polyhedron) {
        for (std::uint64_t f = mesh.cell_faces[cell]; f < mesh.cell_faces[cell + 1]; ++f)
            faces.emplace_back(mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f]),
                               mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f + 1]));
        return faces;
    }
    const auto nodes = mesh.cell_nodes(cell);
    for (const LocalFace& face : faces_of(mesh.types[cell])) {
        faces.emplace_back();
        for (const std::uint8_t corner : face.corners()) faces.back().push_back(nodes[corner]);
    }
    return faces;
}

void add_parts(const Object& object, std::vector<ScenePart>& parts) {
    std::visit([&](const auto& o) { add_object(o, parts); }, object);
}

}  // namespace geomend::scene
