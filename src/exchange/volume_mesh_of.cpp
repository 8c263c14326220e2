// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/volume_mesh_of.h"

#include <algorithm>
#include <string>

#include "exchange/attribute_merge.h"
#include "exchange/cell_mesh_of.h"
#include "exchange/region_faces.h"
#include "exchange/solid_cells.h"
#include "exchange/surface_faces.h"
#include "model/attribute_operations.h"

namespace geomend::exchange {

namespace {

using Data = VolumeMeshData;
using Edge = std::array<std::uint32_t, 2>;

/// Name of an entity or of a group of it; empty where it has none.
std::string stated_name(const CellMesh& mesh, const CellMesh::Entity& entity) {
    if (!entity.name.empty()) return entity.name;
    for (const std::uint32_t g : entity.groups) {
        if (!mesh.groups[g].name.empty()) return mesh.groups[g].name;
    }
    return {};
}

/// The edges of a line-like cell in the order in which they run; further nodes of second order lie between its ends.
std::vector<Edge> edges_along(const CellMesh& mesh, std::size_t cell) {
    const auto nodes = mesh.cell_nodes(cell);
    if (mesh.types[cell] == CellType::quadratic_edge) return {{nodes[0], nodes[2]}, {nodes[2], nodes[1]}};
    std::vector<Edge> edges;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) edges.push_back({nodes[i], nodes[i + 1]});
    return edges;
}

/// The named lines of a mesh as edge sets, its named points and sets of points as node sets.
class NamedSets {
public:
    NamedSets(const CellMesh& mesh, SolidCells& cells, std::vector<Loss>& losses) : m_(mesh), s_(cells), losses_(losses) {}

    void add() {
        std::vector<std::vector<std::uint32_t>> cells_of(m_.entities.size());
        for (std::uint32_t c = 0; c < m_.cell_entity.size(); ++c) {
            const std::uint32_t e = m_.cell_entity[c];
            if (e != no_index && m_.entities[e].dimension < 2 && m_.entities[e].dimension == dimension(m_.types[c]))
                cells_of[e].push_back(c);
        }
        for (std::size_t e = 0; e < cells_of.size(); ++e) {
            const std::string name = stated_name(m_, m_.entities[e]);
            if (cells_of[e].empty() || name.empty()) continue;
            if (m_.entities[e].dimension == 1) add_line(name, cells_of[e]);
            else add_points(name, cells_of[e]);
        }
        for (const NamedSet& set : m_.info.sets) {
            if (set.location == AttributeLocation::point) add_nodes(set.name, set.members);
            else lose(set.name, "set of cells", "a volume mesh has regions, and sets of faces, edges and nodes", set.members.size());
        }
    }

private:
    void add_line(const std::string& name, const std::vector<std::uint32_t>& cells) {
        Data::EdgeSet set{name, {}};
        std::uint64_t away = 0;
        for (const std::uint32_t c : cells) {
            for (const Edge& e : edges_along(m_, c)) {
                const Edge edge{s_.vertex_of[e[0]], s_.vertex_of[e[1]]};
                if (edge[0] == no_index || edge[1] == no_index) ++away;
                else if (edge[0] != edge[1]) set.edges.push_back(edge);
            }
        }
        if (away > 0) lose(name, "edges", "no cell has their points", away);
        if (!set.edges.empty()) s_.data.edge_sets.push_back(std::move(set));
    }
    void add_points(const std::string& name, const std::vector<std::uint32_t>& cells) {
        std::vector<std::uint32_t> points;
        for (const std::uint32_t c : cells) points.insert(points.end(), m_.cell_nodes(c).begin(), m_.cell_nodes(c).end());
        add_nodes(name, points);
    }
    void add_nodes(const std::string& name, const std::vector<std::uint32_t>& points) {
        Data::NodeSet set{name.empty() ? "nodes" : name, {}};
        for (const std::uint32_t p : points) set.nodes.push_back(s_.vertex_of[p]);
        std::ranges::sort(set.nodes);
        const auto away = static_cast<std::uint64_t>(std::ranges::count(set.nodes, no_index));
        set.nodes.resize(set.nodes.size() - away);
        set.nodes.erase(std::ranges::unique(set.nodes).begin(), set.nodes.end());
        if (away > 0) lose(name, "points of a set", "no cell has them", away);
        if (!set.nodes.empty()) s_.data.node_sets.push_back(std::move(set));
    }
    void lose(const std::string& entity, const char* what, const char* why, std::uint64_t count) {
        add_loss(losses_, {LossClass::substance, entity, what, why, count});
    }

    const CellMesh& m_;
    SolidCells& s_;
    std::vector<Loss>& losses_;
};

/// The smallest entity of the model that holds each vertex.
void find_vertex_places(const BrepData& model, SolidCells& cells) {
    Data& d = cells.data;
    std::vector<Data::VertexPlace> of_place(cells.places.positions().size());
    for (auto block = d.blocks.rbegin(); block != d.blocks.rend(); ++block) {  // the first region of a vertex is kept
        for (std::uint64_t k = d.cell_offsets[block->first]; k < d.cell_offsets[block->first + block->count]; ++k)
            d.vertex_places[d.cell_nodes[k]] = {Data::Place::region, block->region};
    }
    const auto put = [&](VertexId v, Data::Place place, std::size_t entity) {
        const std::uint32_t p = cells.places.find(model.vertices[v.value]);
        if (p != no_index && of_place[p].place < place) of_place[p] = {place, static_cast<std::uint32_t>(entity)};
    };
    for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
        const auto& surface = model.surfaces[s];
        for (const std::uint32_t node : surface.polygons.corners) put(surface.nodes[node], Data::Place::surface, s);
    }
    for (std::size_t l = 0; l < model.lines.size(); ++l) {
        for (const VertexId v : model.lines[l].vertices) put(v, Data::Place::line, l);
        d.lines.push_back(model.lines[l].name);
    }
    for (std::size_t c = 0; c < model.corners.size(); ++c) {
        put(model.corners[c].vertex, Data::Place::corner, c);
        d.corners.push_back(model.corners[c].name);
    }
    for (std::size_t v = 0; v < d.vertices.size(); ++v) {
        const Data::VertexPlace& place = of_place[cells.place_of[v]];
        if (place.place != Data::Place::region) d.vertex_places[v] = place;
    }
}

/// How many things below three dimensions have a value.
std::uint64_t values_outside(const CellMesh& mesh, const Attribute& a) {
    std::uint64_t count = 0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (dimension(mesh.types[c]) == 3) continue;
        bool missing = true;
        for (std::size_t k = 0; missing && k < a.components; ++k) {
            const double value = value_as_double(a, c * a.components + k);
            missing = value != value || is_no_data(a, value);
        }
        if (!missing) ++count;
    }
    return count;
}

void add_attributes(const CellMesh& mesh, SolidCells& cells, std::vector<Loss>& losses) {
    const auto lose = [&](const Attribute& a, const char* why, std::uint64_t count) {
        add_loss(losses, {LossClass::substance, mesh.info.name, "attribute '" + a.name + "'", why, count});
    };
    std::vector<std::uint32_t> points, vertices;
    for (std::uint32_t p = 0; p < cells.vertex_of.size(); ++p) {
        if (cells.vertex_of[p] == no_index) continue;
        points.push_back(p);
        vertices.push_back(cells.vertex_of[p]);
    }
    AttributeMerge merge;
    for (const Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::point && a.name == doubled_from) continue;  // the positions say it
        if (a.location == AttributeLocation::point) {
            merge.add({taken(a, points)}, AttributeLocation::point, AttributeLocation::point, vertices);
        } else if (a.location == AttributeLocation::cell && !a.corner_values) {
            if (const auto outside = values_outside(mesh, a); outside > 0) lose(a, "only cells with a volume keep its values", outside);
            merge.add({taken(a, cells.source_cells)}, AttributeLocation::cell, 0, cells.source_cells.size());
        } else if (a.location == AttributeLocation::object) {
            cells.data.attributes.push_back(a);
        } else {
            lose(a, "a volume mesh has values at vertices and in cells", 1);
        }
    }
    merge.extend(AttributeLocation::point, cells.data.vertices.size());
    merge.extend(AttributeLocation::cell, cells.source_cells.size());
    for (Attribute& a : merge.finish(mesh.info.name, losses)) cells.data.attributes.push_back(std::move(a));
}

/// What of a model has no place beside cells.
void list_model_losses(const BrepData& model, std::vector<Loss>& losses) {
    for (const auto& region : model.regions) {
        if (region.cell_types.empty()) add_loss(losses, {LossClass::substance, region.name, "region", "it has no cells", 1});
    }
    const auto lose = [&](std::size_t count, const char* what) {
        if (count > 0) add_loss(losses, {LossClass::identity, model.name, what, "a volume mesh has no place for them", count});
    };
    lose(model.layers.size(), "layers");
    lose(model.fault_blocks.size(), "fault blocks");
    lose(model.features.size(), "geological features");
}

Failure no_mesh(const CellMesh& mesh, const std::string& why, const char* measure) {
    Failure failed = failure(FailureKind::cannot_hold, "F021", {}, (mesh.info.name.empty() ? "" : "'" + mesh.info.name + "': ") + why);
    failed.error.measures = {{measure, 1}};
    return failed;
}

bool has_volume_cells(const CellMesh& mesh) {
    return std::ranges::any_of(mesh.types, [](CellType type) { return dimension(type) == 3; });
}

}  // namespace

Result<VolumeMesh> volume_mesh_of(const CellMesh& mesh, const BrepData* model, std::vector<Loss>& losses) {
    if (!has_volume_cells(mesh)) return no_mesh(mesh, "there are no cells that fill a volume", "without_cells");
    SolidCells cells = solid_cells(mesh, losses);
    if (cells.data.blocks.empty())
        return no_mesh(mesh, "no cell can be written: each uses a point twice, or does not close", "unsound_cells");
    if (model != nullptr) {
        add_surface_faces(*model, cells, losses);
        cells.data.vertex_places.resize(cells.data.vertices.size());
        find_vertex_places(*model, cells);
        list_model_losses(*model, losses);
    }
    add_region_faces(cells);
    NamedSets(mesh, cells, losses).add();
    add_attributes(mesh, cells, losses);
    auto made = VolumeMesh::make(std::move(cells.data));
    if (!made)
        return no_mesh(
            mesh, "the cells cannot be written as one mesh (" + made.why().error.message + "); 'geomend repair --step clean' may mend them",
            "unsound_cells");
    return made;
}

}  // namespace geomend::exchange
