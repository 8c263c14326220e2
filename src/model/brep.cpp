// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/brep.h"

#include <algorithm>
#include <span>
#include <string>

namespace geomend {

namespace {

/// Offsets of `things` things into an array of `size` values.
bool are_offsets(const std::vector<std::uint64_t>& offsets, std::size_t things, std::size_t size) {
    return offsets.size() == things + 1 && offsets.front() == 0 && offsets.back() == size && std::ranges::is_sorted(offsets);
}

/// Numbers below `count`.
template <class IdType>
bool in_range(const std::vector<IdType>& ids, std::size_t count) {
    return std::ranges::all_of(ids, [&](IdType id) { return id.value < count; });
}
bool in_range(const std::vector<std::uint32_t>& indices, std::size_t count) {
    return std::ranges::all_of(indices, [&](std::uint32_t i) { return i < count; });
}
template <class IdType>
bool in_range_or_none(IdType id, std::size_t count) {
    return !id.valid() || id.value < count;
}

std::string check_lines(const BrepData& d) {
    for (const auto& corner : d.corners) {
        if (corner.vertex.value >= d.vertices.size()) return "vertex of corner " + corner.name;
    }
    for (std::size_t i = 0; i < d.lines.size(); ++i) {
        const auto& line = d.lines[i];
        const std::string of = " of line " + std::to_string(i);
        if (line.vertices.size() < 2) return "number of vertices" + of;
        if (!in_range(line.vertices, d.vertices.size())) return "vertex" + of;
        if (line.corners[0].value >= d.corners.size() || line.corners[1].value >= d.corners.size()) return "corner" + of;
        if (d.corners[line.corners[0].value].vertex != line.vertices.front()) return "corner at the start" + of;
        if (d.corners[line.corners[1].value].vertex != line.vertices.back()) return "corner at the end" + of;
        if (!in_range_or_none(line.contact, d.contacts.size())) return "contact" + of;
    }
    return {};
}

/// The number of values for `count` things at a location, or what is wrong.
std::string check_attributes(const std::vector<Attribute>& attributes, AttributeLocation location, std::size_t count) {
    for (const Attribute& a : attributes) {
        if (a.location == location && value_count(a) != count * a.components) return "values of attribute " + a.name;
    }
    return {};
}

/// The node at the end of the edge that starts at corner `c` of a polygon with corners [first, last).
std::uint32_t end_of_edge(const Polygons& polygons, std::size_t first, std::size_t last, std::size_t c) {
    return polygons.corners[c + 1 == last ? first : c + 1];
}

/// Whether polygon q has the edge of the nodes a and b and names p across it.
bool names_back(const BrepData::Surface& s, std::uint32_t p, std::uint32_t q, std::uint32_t a, std::uint32_t b) {
    const std::size_t first = s.polygons.first_corner(q), last = s.polygons.first_corner(std::size_t{q} + 1);
    for (std::size_t c = first; c < last; ++c) {
        if (s.neighbours[c] != p) continue;
        const std::uint32_t from = s.polygons.corners[c], to = end_of_edge(s.polygons, first, last, c);
        if ((from == a && to == b) || (from == b && to == a)) return true;
    }
    return false;
}

std::string check_adjacency(const BrepData::Surface& s) {
    if (s.neighbours.empty()) return {};
    if (s.neighbours.size() != s.polygons.corners.size()) return "number of neighbours";
    const std::size_t count = s.polygons.size();
    for (std::size_t p = 0; p < count; ++p) {
        const std::size_t first = s.polygons.first_corner(p), last = s.polygons.first_corner(p + 1);
        for (std::size_t c = first; c < last; ++c) {
            const std::uint32_t q = s.neighbours[c];
            if (q == no_index) continue;
            if (q >= count || q == p) return "neighbour";
            const std::uint32_t a = s.polygons.corners[c], b = end_of_edge(s.polygons, first, last, c);
            if (!names_back(s, static_cast<std::uint32_t>(p), q, a, b)) return "one-sided adjacency";
        }
    }
    return {};
}

std::string check_surface(const BrepData& d, const BrepData::Surface& s) {
    if (!in_range(s.nodes, d.vertices.size())) return "vertex";
    const auto& polygons = s.polygons;
    if (polygons.all_triangles() ? polygons.corners.size() % 3 != 0
                                 : !are_offsets(polygons.offsets, polygons.offsets.size() - 1, polygons.corners.size())) {
        return "offsets of polygons";
    }
    if (!in_range(polygons.corners, s.nodes.size())) return "node of a polygon";
    if (auto wrong = check_adjacency(s); !wrong.empty()) return wrong;
    for (const auto& border : s.lines) {
        if (border.line.value >= d.lines.size()) return "line";
    }
    for (const RegionId r : s.regions) {
        if (!in_range_or_none(r, d.regions.size())) return "region";
    }
    if (!in_range_or_none(s.interface_id, d.interfaces.size())) return "interface";
    if (auto wrong = check_attributes(s.attributes, AttributeLocation::point, s.nodes.size()); !wrong.empty()) return wrong;
    return check_attributes(s.attributes, AttributeLocation::polygon, polygons.size());
}

bool sides_in_range(const BrepData& d, const std::vector<BrepData::Side>& sides) {
    return std::ranges::all_of(sides, [&](const auto& side) { return side.surface.value < d.surfaces.size(); });
}

std::string check_cells(const BrepData::Region& region) {
    const std::size_t cells = region.cell_types.size();
    if (!are_offsets(region.cell_offsets, cells, region.cell_nodes.size())) return "offsets of cells";
    if (!in_range(region.cell_nodes, region.nodes.size())) return "node of a cell";
    for (std::size_t c = 0; c < cells; ++c) {
        const std::uint32_t wanted = node_count(region.cell_types[c]);
        if (wanted != 0 && region.cell_offsets[c + 1] - region.cell_offsets[c] != wanted) return "number of nodes of a cell";
    }
    if (region.cell_faces.empty() && region.face_offsets.empty() && region.face_nodes.empty()) return {};
    if (region.face_offsets.empty()) return "offsets of faces";
    const std::size_t faces = region.face_offsets.size() - 1;
    if (!are_offsets(region.cell_faces, cells, faces)) return "faces of cells";
    if (!are_offsets(region.face_offsets, faces, region.face_nodes.size())) return "offsets of faces";
    if (!in_range(region.face_nodes, region.nodes.size())) return "node of a face";
    return {};
}

std::string check_region(const BrepData& d, const BrepData::Region& region) {
    if (!sides_in_range(d, region.sides)) return "surface";
    if (!in_range(region.nodes, d.vertices.size())) return "vertex";
    if (auto wrong = check_cells(region); !wrong.empty()) return wrong;
    if (auto wrong = check_attributes(region.attributes, AttributeLocation::point, region.nodes.size()); !wrong.empty()) return wrong;
    return check_attributes(region.attributes, AttributeLocation::cell, region.cell_types.size());
}

std::string check_geology(const BrepData& d) {
    for (const auto& interface : d.interfaces) {
        if (!in_range(interface.surfaces, d.surfaces.size())) return "surface of interface " + interface.name;
    }
    for (const auto& feature : d.features) {
        if (!in_range(feature.surfaces, d.surfaces.size())) return "surface of feature " + feature.name;
    }
    for (const auto& contact : d.contacts) {
        if (!in_range(contact.lines, d.lines.size())) return "line of contact " + contact.name;
        for (const InterfaceId i : contact.interfaces) {
            if (!in_range_or_none(i, d.interfaces.size())) return "interface of contact " + contact.name;
        }
        if (!std::ranges::is_sorted(contact.interfaces)) return "order of the interfaces of contact " + contact.name;
    }
    for (const auto* lists : {&d.layers, &d.fault_blocks}) {
        for (const auto& list : *lists) {
            if (!in_range(list.regions, d.regions.size())) return "region of " + list.name;
        }
    }
    return {};
}

std::string check(const BrepData& d) {
    if (auto wrong = check_attributes(d.vertex_attributes, AttributeLocation::point, d.vertices.size()); !wrong.empty()) return wrong;
    if (auto wrong = check_lines(d); !wrong.empty()) return wrong;
    for (const auto& surface : d.surfaces) {
        if (auto wrong = check_surface(d, surface); !wrong.empty()) return wrong + " of surface " + surface.name;
    }
    for (const auto& region : d.regions) {
        if (auto wrong = check_region(d, region); !wrong.empty()) return wrong + " of region " + region.name;
    }
    if (!sides_in_range(d, d.universe)) return "surface of the Universe";
    return check_geology(d);
}

}  // namespace

Result<Brep> Brep::make(BrepData data) {
    const std::string wrong = check(data);
    if (!wrong.empty()) return failure(FailureKind::internal, "F113", {}, "inconsistent boundary representation: " + wrong);
    return Brep(std::move(data));
}

}  // namespace geomend
