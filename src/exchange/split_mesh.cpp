// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/split_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "exchange/inner_faces.h"
#include "model/attribute_operations.h"

namespace geomend::exchange {

namespace {

using Data = VolumeMeshData;

/// A face that two cells share.
struct SharedFace {
    InnerFace faces;
    bool is_split = false;
};

/// The faces of surfaces that are to be split, ascending, with their sides.
std::vector<std::pair<CellFaceRef, FaceSide>> faces_to_split(const Data& mesh, std::span<const std::uint8_t> split) {
    std::vector<std::pair<CellFaceRef, FaceSide>> faces;
    for (const Data::FaceSet& set : mesh.face_sets) {
        if (set.surface == no_index || split[set.surface] == 0) continue;
        for (const CellFaceRef& face : set.faces) faces.push_back({face, set.side});
    }
    std::ranges::sort(faces);
    return faces;
}

FaceSide opposite(FaceSide side) {
    switch (side) {
        case FaceSide::front:
            return FaceSide::back;
        case FaceSide::back:
            return FaceSide::front;
        case FaceSide::hanging_wall:
            return FaceSide::footwall;
        case FaceSide::footwall:
            return FaceSide::hanging_wall;
        default:
            return FaceSide::none;
    }
}

/// Parts of the cells around vertices; a corner is a place in cell_nodes.
class Parts {
public:
    Parts(const Data& mesh, std::span<const SharedFace> faces)
        : mesh_(mesh), on_split_(mesh.vertices.size(), 0), parts_(mesh.cell_nodes.size()), all_(0) {
        for (const SharedFace& face : faces) {
            if (!face.is_split) continue;
            for (const std::uint32_t v : nodes_of(mesh, face.faces[0])) on_split_[v] = 1;
        }
        for (const SharedFace& face : faces) {
            if (!face.is_split) join(parts_, face);
        }
        all_ = parts_;
        for (const SharedFace& face : faces) {
            if (face.is_split) join(all_, face);
        }
    }

    /// For each corner the vertex that it has from now on; those behind the mesh's own are listed in `origins` as what they were.
    std::vector<std::uint32_t> vertices(std::vector<std::uint32_t>& origins) {
        std::vector<std::uint32_t> of_corner(mesh_.cell_nodes);
        std::vector<std::uint8_t> is_kept(of_corner.size(), 0);  // whether a part of those that hung together has kept the vertex
        for (std::uint32_t corner = 0; corner < of_corner.size(); ++corner) {
            const std::uint32_t vertex = mesh_.cell_nodes[corner], part = parts_.root(corner), all = all_.root(corner);
            if (on_split_[vertex] == 0) continue;
            if (part != corner) {
                of_corner[corner] = of_corner[part];
            } else if (is_kept[all] == 0) {
                is_kept[all] = 1;
            } else {
                of_corner[corner] = static_cast<std::uint32_t>(mesh_.vertices.size() + origins.size());
                origins.push_back(vertex);
            }
        }
        return of_corner;
    }

private:
    const Data& mesh_;
    std::vector<std::uint8_t> on_split_;
    DisjointSets parts_, all_;

    std::uint32_t corner_of(std::uint32_t cell, std::uint32_t vertex) const {
        std::uint64_t corner = mesh_.cell_offsets[cell];
        while (mesh_.cell_nodes[corner] != vertex) ++corner;
        return static_cast<std::uint32_t>(corner);
    }
    void join(DisjointSets& sets, const SharedFace& face) const {
        for (const std::uint32_t v : nodes_of(mesh_, face.faces[0])) {
            if (on_split_[v] != 0) sets.join(corner_of(face.faces[0].cell, v), corner_of(face.faces[1].cell, v));
        }
    }
};

void renumber_cells(Data& mesh, const std::vector<std::uint32_t>& of_corner) {
    for (const Data::Block& block : mesh.blocks) {
        if (block.type != CellType::polyhedron) continue;
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            const auto nodes = mesh.nodes_of(c);
            for (std::uint64_t k = mesh.face_offsets[mesh.cell_faces[c]]; k < mesh.face_offsets[mesh.cell_faces[c + 1]]; ++k) {
                const auto at = static_cast<std::uint64_t>(std::ranges::find(nodes, mesh.face_nodes[k]) - nodes.begin());
                mesh.face_nodes[k] = of_corner[mesh.cell_offsets[c] + at];
            }
        }
    }
    mesh.cell_nodes = of_corner;
}

/// Edges go on along vertices that a cell has in common: as they were where there is one, else the first made of them.
void renumber_edges(Data& mesh) {
    if (mesh.edge_sets.empty()) return;
    using Edge = std::array<std::uint32_t, 2>;
    std::map<Edge, Edge> edge_of;  // by what the ends were made from
    for (Data::EdgeSet& set : mesh.edge_sets) {
        for (const Edge& e : set.edges) edge_of[{std::min(e[0], e[1]), std::max(e[0], e[1])}] = {no_index, no_index};
    }
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
        const auto nodes = mesh.nodes_of(c);
        for (const std::uint32_t a : nodes) {
            for (const std::uint32_t b : nodes) {
                const auto at = edge_of.find({mesh.vertex_origins[a], mesh.vertex_origins[b]});
                if (at != edge_of.end()) at->second = std::min(at->second, Edge{a, b});
            }
        }
    }
    for (Data::EdgeSet& set : mesh.edge_sets) {
        for (Edge& e : set.edges) {
            const Edge now = edge_of[{std::min(e[0], e[1]), std::max(e[0], e[1])}];
            if (now[0] == no_index) continue;  // no cell has it
            e = e[0] <= e[1] ? now : Edge{now[1], now[0]};
        }
    }
}

/// Takes what stands on vertices along to those that were made of them.
void extend_vertices(Data& mesh, const std::vector<std::uint32_t>& made_from) {
    const std::size_t before = mesh.vertices.size();
    if (mesh.vertex_origins.empty()) {
        mesh.vertex_origins.resize(before);
        std::iota(mesh.vertex_origins.begin(), mesh.vertex_origins.end(), 0u);
    }
    std::vector<std::uint32_t> rows(before);
    std::iota(rows.begin(), rows.end(), 0u);
    for (const std::uint32_t from : made_from) {
        mesh.vertices.push_back(mesh.vertices[from]);
        mesh.vertex_origins.push_back(mesh.vertex_origins[from]);
        if (!mesh.vertex_places.empty()) mesh.vertex_places.push_back(mesh.vertex_places[from]);
        rows.push_back(from);
    }
    for (Attribute& a : mesh.attributes) {
        if (a.location == AttributeLocation::point) a = taken(a, rows);
    }
    for (Data::NodeSet& set : mesh.node_sets) {
        std::vector<std::uint32_t> made;
        for (std::size_t i = 0; i < made_from.size(); ++i) {
            if (std::ranges::binary_search(set.nodes, made_from[i])) made.push_back(static_cast<std::uint32_t>(before + i));
        }
        set.nodes.insert(set.nodes.end(), made.begin(), made.end());
    }
}

std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> nodes) {
    std::ranges::sort(nodes);
    return nodes;
}

void add_pairs(Data& mesh, std::span<const SharedFace> faces, std::span<const std::pair<CellFaceRef, FaceSide>> split) {
    const auto side_of = [&](const CellFaceRef& face) {
        const auto at = std::ranges::lower_bound(split, face, {}, [](const auto& s) { return s.first; });
        return at != split.end() && at->first == face ? at->second : FaceSide::none;
    };
    for (const SharedFace& face : faces) {
        if (!face.is_split || sorted(nodes_of(mesh, face.faces[0])) == sorted(nodes_of(mesh, face.faces[1]))) continue;
        std::array<FaceSide, 2> sides{side_of(face.faces[0]), side_of(face.faces[1])};
        if (sides[0] == FaceSide::none) sides[0] = opposite(sides[1]);
        if (sides[0] == FaceSide::none) sides[0] = FaceSide::front;
        if (sides[1] == FaceSide::none || sides[1] == sides[0]) sides[1] = opposite(sides[0]);
        mesh.split_pairs.push_back({face.faces, sides});
    }
}

bool has_nodes_between_corners(const Data& mesh) {
    return std::ranges::any_of(mesh.blocks, [](const Data::Block& block) { return is_second_order(block.type); });
}

Failure second_order_stays() {
    return failure(FailureKind::cannot_hold, "F021", {}, "cells of the second order are not split along surfaces, nor joined there");
}

/// How many things have values of their own beside those of what they become one with.
std::uint64_t differing_values(const Attribute& a, std::span<const std::uint32_t> origins) {
    return std::visit(
        [&](const auto& values) {
            std::uint64_t count = 0;
            for (std::size_t v = 0; v < origins.size(); ++v) {
                for (std::size_t k = 0; k < a.components; ++k) {
                    if (same_value(values[v * a.components + k], values[origins[v] * a.components + k])) continue;
                    ++count;
                    break;
                }
            }
            return count;
        },
        a.values);
}

}  // namespace

std::vector<std::uint8_t> faults_of(const VolumeMesh& mesh) {
    std::vector<std::uint8_t> faults(mesh->surfaces.size(), 0);
    for (const Data::FaceSet& set : mesh->face_sets) {
        if (set.surface != no_index && set.role == FeatureRole::fault) faults[set.surface] = 1;
    }
    return faults;
}

Result<VolumeMesh> split_along(const VolumeMesh& mesh, std::span<const std::uint8_t> split) {
    if (has_nodes_between_corners(*mesh)) return second_order_stays();
    const auto to_split = faces_to_split(*mesh, split);
    std::vector<SharedFace> faces;
    for (const InnerFace& face : inner_faces(*mesh)) faces.push_back({face, false});
    const auto is_to_split = [&](const CellFaceRef& face) {
        const auto at = std::ranges::lower_bound(to_split, face, {}, [](const auto& s) { return s.first; });
        return at != to_split.end() && at->first == face;
    };
    for (SharedFace& face : faces) face.is_split = is_to_split(face.faces[0]) || is_to_split(face.faces[1]);
    std::vector<std::uint32_t> made_from;
    const std::vector<std::uint32_t> of_corner = Parts(*mesh, faces).vertices(made_from);
    if (made_from.empty()) return mesh;
    Data data = *mesh;
    extend_vertices(data, made_from);
    renumber_cells(data, of_corner);
    renumber_edges(data);
    add_pairs(data, faces, to_split);
    return VolumeMesh::make(std::move(data));
}

Result<VolumeMesh> joined(const VolumeMesh& mesh, std::vector<Loss>& losses) {
    if (mesh->vertex_origins.empty()) return mesh;
    if (has_nodes_between_corners(*mesh)) return second_order_stays();
    Data data = *mesh;
    const std::vector<std::uint32_t> origins = std::move(data.vertex_origins);
    data.vertex_origins.clear();
    data.split_pairs.clear();
    std::vector<std::uint32_t> rows, number(origins.size(), no_index);
    for (std::uint32_t v = 0; v < origins.size(); ++v) {
        if (origins[v] != v) continue;
        number[v] = static_cast<std::uint32_t>(rows.size());
        rows.push_back(v);
    }
    const auto renumber = [&](std::uint32_t& v) { v = number[origins[v]]; };
    std::ranges::for_each(data.cell_nodes, renumber);
    std::ranges::for_each(data.face_nodes, renumber);
    for (Data::EdgeSet& set : data.edge_sets) {
        for (auto& edge : set.edges) std::ranges::for_each(edge, renumber);
    }
    for (Data::NodeSet& set : data.node_sets) {
        std::ranges::for_each(set.nodes, renumber);
        std::ranges::sort(set.nodes);
        set.nodes.erase(std::ranges::unique(set.nodes).begin(), set.nodes.end());
    }
    for (std::size_t i = 0; i < rows.size(); ++i) data.vertices[i] = data.vertices[rows[i]];
    data.vertices.resize(rows.size());
    if (!data.vertex_places.empty()) {
        for (std::size_t i = 0; i < rows.size(); ++i) data.vertex_places[i] = data.vertex_places[rows[i]];
        data.vertex_places.resize(rows.size());
    }
    for (Attribute& a : data.attributes) {
        if (a.location != AttributeLocation::point) continue;
        if (const auto count = differing_values(a, origins); count > 0)
            add_loss(losses, {LossClass::substance, data.name, "values of attribute '" + a.name + "'",
                              "vertices that were doubled become one, with the values of the first", count});
        a = taken(a, rows);
    }
    auto made = VolumeMesh::make(std::move(data));
    if (!made) {
        Failure why = failure(FailureKind::cannot_hold, "F021", {},
                              "the doubled vertices of the mesh cannot become one again: " + made.why().error.message);
        why.error.measures = {{"unsound_cells", 1}};
        return why;
    }
    return made;
}

}  // namespace geomend::exchange
