// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/volume_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/cell_faces.h"
#include "model/face_groups.h"

namespace geomend {

namespace {

using Data = VolumeMeshData;

Failure bad_mesh(const char* what, std::size_t at) {
    return failure(FailureKind::internal, "", {}, std::string("volume mesh: ") + what + " " + std::to_string(at));
}

const Data::Block& block_at(const Data& d, std::uint32_t cell) {
    const auto after =
        std::upper_bound(d.blocks.begin(), d.blocks.end(), cell, [](std::uint32_t c, const Data::Block& b) { return c < b.first; });
    return *std::prev(after);
}

std::size_t face_count(const Data& d, std::uint32_t cell) {
    const CellType type = block_at(d, cell).type;
    return type == CellType::polyhedron ? static_cast<std::size_t>(d.cell_faces[cell + 1] - d.cell_faces[cell]) : faces_of(type).size();
}

void face_nodes_of(const Data& d, CellType type, const CellFaceRef& ref, std::vector<std::uint32_t>& nodes) {
    nodes.clear();
    if (type == CellType::polyhedron) {
        const std::uint64_t f = d.cell_faces[ref.cell] + ref.face;
        for (std::uint64_t i = d.face_offsets[f]; i < d.face_offsets[f + 1]; ++i) nodes.push_back(d.face_nodes[i]);
        return;
    }
    const auto cell = d.nodes_of(ref.cell);
    for (const std::uint8_t corner : faces_of(type)[ref.face].corners()) nodes.push_back(cell[corner]);
}

/// Offsets that begin at 0, never go back and end at a size.
bool are_offsets(const std::vector<std::uint64_t>& offsets, std::size_t end) {
    return !offsets.empty() && offsets.front() == 0 && offsets.back() == end && std::is_sorted(offsets.begin(), offsets.end());
}

bool has_repetition(std::vector<std::uint32_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    return std::adjacent_find(numbers.begin(), numbers.end()) != numbers.end();
}

bool all_below(std::span<const std::uint32_t> numbers, std::size_t size) {
    return std::all_of(numbers.begin(), numbers.end(), [&](std::uint32_t i) { return i < size; });
}

Result<void> check_vertices(const Data& d) {
    if (d.vertices.size() >= no_index) return bad_mesh("more vertices than a number can name:", d.vertices.size());
    for (std::size_t v = 0; v < d.vertices.size(); ++v) {
        for (const double x : d.vertices[v]) {
            if (!std::isfinite(x)) return bad_mesh("no finite position: vertex", v);
        }
    }
    return {};
}

Result<void> check_blocks(const Data& d) {
    if (d.cell_offsets.empty() || d.cell_count() >= no_index) return bad_mesh("offsets of cells:", d.cell_offsets.size());
    std::uint64_t next = 0;
    for (std::size_t b = 0; b < d.blocks.size(); ++b) {
        const Data::Block& block = d.blocks[b];
        if (block.region >= d.regions.size()) return bad_mesh("region out of range: block", b);
        if (block.type != CellType::polyhedron && faces_of(block.type).empty()) return bad_mesh("no volume cells: block", b);
        if (block.first != next || block.count == 0) return bad_mesh("blocks do not follow each other: block", b);
        next += block.count;
        if (b == 0) continue;
        const Data::Block& before = d.blocks[b - 1];
        if (!(std::pair(before.region, before.type) < std::pair(block.region, block.type))) return bad_mesh("not sorted: block", b);
    }
    if (next != d.cell_count()) return bad_mesh("blocks do not cover the cells:", static_cast<std::size_t>(next));
    return {};
}

Result<void> check_cells(const Data& d) {
    if (!are_offsets(d.cell_offsets, d.cell_nodes.size()))
        return bad_mesh("offsets of cells do not match their nodes:", d.cell_nodes.size());
    for (const Data::Block& block : d.blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            const auto nodes = d.nodes_of(c);
            const std::uint32_t expected = node_count(block.type);
            if (expected == 0 ? nodes.size() < 4 : nodes.size() != expected) return bad_mesh("wrong number of nodes: cell", c);
            if (!all_below(nodes, d.vertices.size())) return bad_mesh("vertex out of range: cell", c);
            if (has_repetition({nodes.begin(), nodes.end()})) return bad_mesh("a node twice: cell", c);
        }
    }
    return {};
}

/// Whether each edge of the faces of a cell is run along once in either direction, and no face has a node twice or from elsewhere.
bool is_closed(const Data& d, std::uint32_t cell) {
    const auto own = d.nodes_of(cell);
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> face, used;
    for (std::uint32_t f = 0; f < face_count(d, cell); ++f) {
        face_nodes_of(d, CellType::polyhedron, {cell, f}, face);
        if (face.size() < 3 || has_repetition(face)) return false;
        for (std::size_t i = 0; i < face.size(); ++i) {
            if (std::find(own.begin(), own.end(), face[i]) == own.end()) return false;
            edges.push_back({face[i], face[(i + 1) % face.size()]});
        }
        used.insert(used.end(), face.begin(), face.end());
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::sort(edges.begin(), edges.end());
    if (used.size() != own.size() || std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
    return std::all_of(edges.begin(), edges.end(), [&](const std::array<std::uint32_t, 2>& e) {
        return std::binary_search(edges.begin(), edges.end(), std::array<std::uint32_t, 2>{e[1], e[0]});
    });
}

Result<void> check_polyhedra(const Data& d) {
    const bool has_any = std::any_of(d.blocks.begin(), d.blocks.end(), [](const Data::Block& b) { return b.type == CellType::polyhedron; });
    if (!has_any) {
        if (!d.cell_faces.empty() || !d.face_offsets.empty() || !d.face_nodes.empty()) return bad_mesh("faces without polyhedra:", 0);
        return {};
    }
    if (!are_offsets(d.face_offsets, d.face_nodes.size()))
        return bad_mesh("offsets of faces do not match their nodes:", d.face_nodes.size());
    if (d.cell_faces.size() != d.cell_count() + 1 || !are_offsets(d.cell_faces, d.face_offsets.size() - 1)) {
        return bad_mesh("faces do not match the cells:", d.cell_faces.size());
    }
    for (const Data::Block& block : d.blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            if (block.type != CellType::polyhedron) {
                if (d.cell_faces[c] != d.cell_faces[c + 1]) return bad_mesh("stated faces of no polyhedron: cell", c);
            } else if (!is_closed(d, c)) {
                return bad_mesh("not closed: polyhedron", c);
            }
        }
    }
    return {};
}

/// A face by its nodes from the lowest on, in the direction that comes to the lower neighbour first.
struct SharedFace {
    std::vector<std::uint32_t> nodes;
    bool turned = false;
    std::uint32_t cell = 0;
};

SharedFace canonical(std::vector<std::uint32_t> nodes, std::uint32_t cell) {
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
    const bool turned = nodes.back() < nodes[1];
    if (turned) std::reverse(nodes.begin() + 1, nodes.end());
    return {std::move(nodes), turned, cell};
}

/// Whether two tetrahedra share a triangle and have it wound against each other, as nearly always.
bool are_plain_neighbours(const Data& d, std::span<const KnownFace> group) {
    if (group.size() != 2 || group[0].corners != 3) return false;
    std::array<bool, 2> goes_up{};
    for (std::size_t k = 0; k < 2; ++k) {
        const CellFaceRef& ref = group[k].face;
        const std::uint64_t from = d.cell_offsets[ref.cell];
        if (d.cell_offsets[ref.cell + 1] - from != 4) return false;
        const auto corners = faces_of(CellType::tetrahedron)[ref.face].corners();
        std::array<std::uint32_t, 3> nodes{};
        for (std::size_t i = 0; i < 3; ++i) nodes[i] = d.cell_nodes[from + corners[i]];
        const auto low = static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end()) - nodes.begin());
        goes_up[k] = nodes[(low + 1) % 3] < nodes[(low + 2) % 3];
    }
    return goes_up[0] != goes_up[1];
}

/// What is wrong with cells at one face: it has the same lowest corners in each of them.
Result<void> check_face(const Data& d, std::span<const KnownFace> group) {
    std::vector<SharedFace> all;
    std::vector<std::uint32_t> nodes;
    for (const KnownFace& known : group) {
        face_nodes_of(d, block_at(d, known.face.cell).type, known.face, nodes);
        all.push_back(canonical(nodes, known.face.cell));
    }
    std::stable_sort(all.begin(), all.end(), [](const SharedFace& a, const SharedFace& b) { return a.nodes < b.nodes; });
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].nodes != all[i - 1].nodes) continue;
        if (all[i].turned == all[i - 1].turned) return bad_mesh("a face wound as its neighbour's, or a third one on it: cell", all[i].cell);
        if (i >= 2 && all[i].nodes == all[i - 2].nodes) return bad_mesh("a face of three cells: cell", all[i].cell);
    }
    return {};
}

Result<void> check_neighbours(const Data& d) {
    Result<void> checked;
    each_face_group(d, [&](std::span<const KnownFace> group) {
        if (group.size() > 1 && checked && !are_plain_neighbours(d, group)) checked = check_face(d, group);
    });
    return checked;
}

bool is_face(const Data& d, const CellFaceRef& ref) { return ref.cell < d.cell_count() && ref.face < face_count(d, ref.cell); }

Result<void> check_sets(const Data& d) {
    const auto strictly_ascends = [](const auto& list) {
        return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
    };
    for (std::size_t s = 0; s < d.face_sets.size(); ++s) {
        const Data::FaceSet& set = d.face_sets[s];
        if (set.name.empty() || !strictly_ascends(set.faces)) return bad_mesh("no name, or not ascending: face set", s);
        if (set.surface != no_index && set.surface >= d.surfaces.size()) return bad_mesh("surface out of range: face set", s);
        for (const CellFaceRef& ref : set.faces) {
            if (!is_face(d, ref)) return bad_mesh("no face of a cell: face set", s);
        }
    }
    for (std::size_t s = 0; s < d.edge_sets.size(); ++s) {
        if (d.edge_sets[s].name.empty()) return bad_mesh("no name: edge set", s);
        for (const auto& edge : d.edge_sets[s].edges) {
            if (!all_below(edge, d.vertices.size()) || edge[0] == edge[1]) return bad_mesh("no edge: edge set", s);
        }
    }
    for (std::size_t s = 0; s < d.node_sets.size(); ++s) {
        const Data::NodeSet& set = d.node_sets[s];
        if (set.name.empty() || !strictly_ascends(set.nodes)) return bad_mesh("no name, or not ascending: node set", s);
        if (!all_below(set.nodes, d.vertices.size())) return bad_mesh("vertex out of range: node set", s);
    }
    return {};
}

Result<void> check_split(const Data& d) {
    if (d.vertex_origins.empty()) {
        if (!d.split_pairs.empty()) return bad_mesh("pairs of faces without doubled vertices:", d.split_pairs.size());
        return {};
    }
    if (d.vertex_origins.size() != d.vertices.size()) return bad_mesh("origins do not match the vertices:", d.vertex_origins.size());
    for (std::size_t v = 0; v < d.vertex_origins.size(); ++v) {
        const std::uint32_t from = d.vertex_origins[v];
        if (from > v || d.vertex_origins[from] != from || d.vertices[from] != d.vertices[v]) return bad_mesh("wrong origin: vertex", v);
    }
    std::vector<std::uint32_t> first, second;
    for (std::size_t p = 0; p < d.split_pairs.size(); ++p) {
        const auto& [faces, sides] = d.split_pairs[p];
        if (!is_face(d, faces[0]) || !is_face(d, faces[1]) || faces[0] == faces[1]) return bad_mesh("no two faces: pair", p);
        if (sides[0] == sides[1] || sides[0] == FaceSide::none || sides[1] == FaceSide::none) return bad_mesh("no two sides: pair", p);
        face_nodes_of(d, block_at(d, faces[0].cell).type, faces[0], first);
        face_nodes_of(d, block_at(d, faces[1].cell).type, faces[1], second);
        for (std::uint32_t& v : first) v = d.vertex_origins[v];
        for (std::uint32_t& v : second) v = d.vertex_origins[v];
        const SharedFace a = canonical(first, 0), b = canonical(second, 0);
        if (a.nodes != b.nodes || a.turned == b.turned) return bad_mesh("faces that were not one: pair", p);
    }
    return {};
}

Result<void> check_network(const Data& d) {
    if (d.network.empty()) return {};
    if (d.network.volumes.size() != d.cell_count() || d.network.centres.size() != d.cell_count())
        return bad_mesh("volumes and centres do not match the cells:", d.network.volumes.size());
    for (std::size_t i = 0; i < d.network.connections.size(); ++i) {
        const auto& c = d.network.connections[i];
        if (c.from >= c.to || c.to >= d.cell_count()) return bad_mesh("no two cells: connection", i);
    }
    return {};
}

Result<void> check_places_and_attributes(const Data& d) {
    if (!d.vertex_places.empty() && d.vertex_places.size() != d.vertices.size())
        return bad_mesh("places of vertices:", d.vertex_places.size());
    const std::array<std::size_t, 4> entities{d.regions.size(), d.surfaces.size(), d.lines.size(), d.corners.size()};
    for (std::size_t v = 0; v < d.vertex_places.size(); ++v) {
        const auto place = static_cast<std::size_t>(d.vertex_places[v].place);
        if (place >= entities.size() || d.vertex_places[v].entity >= entities[place]) return bad_mesh("no such entity: vertex", v);
    }
    for (std::size_t i = 0; i < d.attributes.size(); ++i) {
        const Attribute& a = d.attributes[i];
        const bool known =
            a.location == AttributeLocation::point || a.location == AttributeLocation::cell || a.location == AttributeLocation::object;
        const std::size_t things = a.location == AttributeLocation::point  ? d.vertices.size()
                                   : a.location == AttributeLocation::cell ? d.cell_count()
                                                                           : 1;
        if (!known || a.components == 0 || value_count(a) != things * a.components) return bad_mesh("number of values: attribute", i);
        if (!a.component_names.empty() && a.component_names.size() != a.components) return bad_mesh("names of components: attribute", i);
    }
    return {};
}

}  // namespace

const char* to_string(FaceSide side) {
    switch (side) {
        case FaceSide::front:
            return "front";
        case FaceSide::back:
            return "back";
        case FaceSide::hanging_wall:
            return "hanging wall";
        case FaceSide::footwall:
            return "footwall";
        default:
            return "none";
    }
}

Result<VolumeMesh> VolumeMesh::make(VolumeMeshData data) {
    for (const auto check : {check_vertices, check_blocks, check_cells, check_polyhedra, check_neighbours, check_sets, check_split,
                             check_places_and_attributes, check_network}) {
        auto checked = check(data);
        if (!checked) return std::move(checked).why();
    }
    return VolumeMesh(std::move(data));
}

const VolumeMeshData::Block& VolumeMesh::block_of(std::uint32_t cell) const { return block_at(data_, cell); }

std::uint32_t VolumeMesh::face_count(std::uint32_t cell) const { return static_cast<std::uint32_t>(geomend::face_count(data_, cell)); }

std::vector<std::uint32_t> VolumeMesh::nodes_of(const CellFaceRef& face) const {
    std::vector<std::uint32_t> nodes;
    face_nodes_of(data_, block_at(data_, face.cell).type, face, nodes);
    return nodes;
}

}  // namespace geomend
