// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/volume_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "base/vectors.h"
#include "model/cell_faces.h"
#include "model/mesh_needs.h"
#include "support/seeds.h"

namespace geomend {
namespace {

using Data = VolumeMeshData;
using Refs = std::vector<CellFaceRef>;

void add_cell(Data& d, std::initializer_list<std::uint32_t> nodes) {
    d.cell_nodes.insert(d.cell_nodes.end(), nodes);
    d.cell_offsets.push_back(d.cell_nodes.size());
}

/// Two regions: a hexahedron with a pyramid on it, and on its other side, split off, a tetrahedron and a polyhedron (a wedge by its faces).
Data hand_made() {
    Data d;
    d.name = "hand made";
    d.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 2},  // hexahedron, tip
                  {1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {2, 0, 0}, {2, 0, 1}, {3, 0, 0}};
    d.regions = {"west", "east"};
    d.surfaces = {"fault"};
    d.lines = {"trace"};
    d.corners = {"tip"};
    d.blocks = {
        {0, CellType::hexahedron, 0, 1}, {0, CellType::pyramid, 1, 1}, {1, CellType::tetrahedron, 2, 1}, {1, CellType::polyhedron, 3, 1}};
    add_cell(d, {0, 1, 2, 3, 4, 5, 6, 7});
    add_cell(d, {4, 5, 6, 7, 8});
    add_cell(d, {13, 15, 10, 14});
    add_cell(d, {9, 10, 11, 12, 13, 14});
    const std::vector<std::vector<std::uint32_t>> faces = {{9, 11, 12, 10}, {9, 10, 13},  {11, 14, 12},
                                                           {9, 13, 14, 11}, {10, 12, 14}, {10, 14, 13}};
    d.cell_faces = {0, 0, 0, 0, 6};
    d.face_offsets = {0};
    for (const auto& f : faces) {
        d.face_nodes.insert(d.face_nodes.end(), f.begin(), f.end());
        d.face_offsets.push_back(d.face_nodes.size());
    }
    d.face_sets = {{"fault_west", FeatureRole::fault, FaceSide::footwall, 0, Refs{{0, 3}}},
                   {"fault_east", FeatureRole::fault, FaceSide::hanging_wall, 0, Refs{{3, 0}}},
                   {"outside", FeatureRole::boundary, FaceSide::none, no_index, Refs{{0, 0}, {0, 2}, {1, 1}}}};
    d.edge_sets = {{"well", {{0, 4}, {4, 8}}}};
    d.node_sets = {{"base", {0, 1, 2, 3}}};
    d.split_pairs = {{{CellFaceRef{0, 3}, CellFaceRef{3, 0}}, {FaceSide::footwall, FaceSide::hanging_wall}}};
    d.vertex_origins.resize(d.vertices.size());
    for (std::uint32_t v = 0; v < d.vertices.size(); ++v) d.vertex_origins[v] = v;
    d.vertex_origins[9] = 1;
    d.vertex_origins[10] = 2;
    d.vertex_origins[11] = 5;
    d.vertex_origins[12] = 6;
    d.vertex_places.resize(d.vertices.size());
    d.vertex_places[1] = {Data::Place::line, 0};
    d.vertex_places[6] = {Data::Place::surface, 0};
    d.vertex_places[8] = {Data::Place::corner, 0};
    d.vertex_places[13] = {Data::Place::region, 1};
    Attribute porosity;
    porosity.name = "porosity";
    porosity.location = AttributeLocation::cell;
    porosity.values = std::vector<double>{0.1, 0.2, 0.3, 0.4};
    Attribute speed;
    speed.name = "speed";
    speed.components = 3;
    speed.values = std::vector<float>(3 * d.vertices.size(), 1.0f);
    d.attributes = {porosity, speed};
    return d;
}

// ---- slow and plain: what VolumeMesh::make() promises, each sentence by itself, with nothing shared with it but the face table

bool offsets_fit(const std::vector<std::uint64_t>& o, std::size_t end) {
    if (o.empty() || o[0] != 0 || o[o.size() - 1] != end) return false;
    for (std::size_t i = 1; i < o.size(); ++i) {
        if (o[i] < o[i - 1]) return false;
    }
    return true;
}

using FaceLists = std::vector<std::vector<std::vector<std::uint32_t>>>;

/// The faces of all cells; nothing where they cannot be listed.
bool list_faces(const Data& d, const std::vector<CellType>& types, FaceLists& lists) {
    bool any = false;
    for (const CellType t : types) any = any || t == CellType::polyhedron;
    if (!any && d.cell_faces.size() + d.face_offsets.size() + d.face_nodes.size() > 0) return false;
    if (any && (!offsets_fit(d.face_offsets, d.face_nodes.size()) || d.cell_faces.size() != types.size() + 1 ||
                !offsets_fit(d.cell_faces, d.face_offsets.size() - 1))) {
        return false;
    }
    lists.resize(types.size());
    for (std::size_t c = 0; c < types.size(); ++c) {
        if (types[c] != CellType::polyhedron) {
            if (any && d.cell_faces[c] != d.cell_faces[c + 1]) return false;
            for (const LocalFace& f : faces_of(types[c])) {
                lists[c].emplace_back();
                for (const std::uint8_t n : f.corners()) lists[c].back().push_back(d.cell_nodes[d.cell_offsets[c] + n]);
            }
            continue;
        }
        const std::set<std::uint32_t> own(d.cell_nodes.begin() + long(d.cell_offsets[c]),
                                          d.cell_nodes.begin() + long(d.cell_offsets[c + 1]));
        std::set<std::uint32_t> used;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (std::uint64_t f = d.cell_faces[c]; f < d.cell_faces[c + 1]; ++f) {
            const std::vector<std::uint32_t> face(d.face_nodes.begin() + long(d.face_offsets[f]),
                                                  d.face_nodes.begin() + long(d.face_offsets[f + 1]));
            if (face.size() < 3 || std::set<std::uint32_t>(face.begin(), face.end()).size() != face.size()) return false;
            for (std::size_t i = 0; i < face.size(); ++i) {
                used.insert(face[i]);
                ++edges[{face[i], face[(i + 1) % face.size()]}];
            }
            lists[c].push_back(face);
        }
        if (used != own) return false;
        for (const auto& [edge, n] : edges) {
            const auto back = edges.find({edge.second, edge.first});
            if (n != 1 || back == edges.end() || back->second != 1) return false;
        }
    }
    return true;
}

/// Whether two cyclic lists have the same members in opposite directions, or in the same.
bool is_turned(const std::vector<std::uint32_t>& a, std::vector<std::uint32_t> b, bool opposite) {
    if (a.size() != b.size()) return false;
    if (opposite) std::reverse(b.begin(), b.end());
    for (std::size_t shift = 0; shift < b.size(); ++shift) {
        std::rotate(b.begin(), b.begin() + 1, b.end());
        if (a == b) return true;
    }
    return false;
}

template <class List>
bool strictly_ascending(const List& list) {
    for (std::size_t i = 1; i < list.size(); ++i) {
        if (!(list[i - 1] < list[i])) return false;
    }
    return true;
}

bool slowly_right(const Data& d) {
    for (const Vec3& p : d.vertices) {
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return false;
    }
    const std::size_t nv = d.vertices.size();
    if (!offsets_fit(d.cell_offsets, d.cell_nodes.size())) return false;
    const std::size_t cells = d.cell_offsets.size() - 1;
    std::vector<CellType> types;
    for (std::size_t b = 0; b < d.blocks.size(); ++b) {
        const auto& k = d.blocks[b];
        if (k.region >= d.regions.size() || dimension(k.type) != 3 || k.count == 0 || k.count > cells || k.first != types.size())
            return false;
        if (b > 0 && (k.region < d.blocks[b - 1].region || (k.region == d.blocks[b - 1].region && k.type <= d.blocks[b - 1].type)))
            return false;
        types.insert(types.end(), k.count, k.type);
    }
    if (types.size() != cells) return false;
    for (std::size_t c = 0; c < cells; ++c) {
        const auto nodes = d.nodes_of(c);
        const std::size_t wanted = node_count(types[c]);
        if (wanted > 0 ? nodes.size() != wanted : nodes.size() < 4) return false;
        for (const std::uint32_t n : nodes) {
            if (n >= nv || std::count(nodes.begin(), nodes.end(), n) != 1) return false;
        }
    }
    FaceLists faces;
    if (!list_faces(d, types, faces)) return false;
    for (std::size_t c = 0; c < cells; ++c) {
        for (std::size_t f = 0; f < faces[c].size(); ++f) {
            int others = 0;
            for (std::size_t e = 0; e < cells; ++e) {
                for (std::size_t g = 0; g < faces[e].size(); ++g) {
                    if (e == c && g == f) continue;
                    if (is_turned(faces[c][f], faces[e][g], false)) return false;
                    if (is_turned(faces[c][f], faces[e][g], true)) ++others;
                }
            }
            if (others > 1) return false;
        }
    }
    const auto exists = [&](const CellFaceRef& r) { return r.cell < cells && r.face < faces[r.cell].size(); };
    for (const auto& s : d.face_sets) {
        if (s.name.empty() || !strictly_ascending(s.faces) || (s.surface != no_index && s.surface >= d.surfaces.size())) return false;
        for (const CellFaceRef& r : s.faces) {
            if (!exists(r)) return false;
        }
    }
    for (const auto& s : d.edge_sets) {
        if (s.name.empty()) return false;
        for (const auto& e : s.edges) {
            if (e[0] >= nv || e[1] >= nv || e[0] == e[1]) return false;
        }
    }
    for (const auto& s : d.node_sets) {
        if (s.name.empty() || !strictly_ascending(s.nodes) || (!s.nodes.empty() && s.nodes.back() >= nv)) return false;
    }
    if (d.vertex_origins.empty() ? !d.split_pairs.empty() : d.vertex_origins.size() != nv) return false;
    for (std::size_t v = 0; v < d.vertex_origins.size(); ++v) {
        const std::uint32_t o = d.vertex_origins[v];
        if (o > v || d.vertex_origins[o] != o || d.vertices[o] != d.vertices[v]) return false;
    }
    for (const auto& p : d.split_pairs) {
        if (!exists(p.faces[0]) || !exists(p.faces[1]) || p.faces[0] == p.faces[1]) return false;
        if (p.sides[0] == FaceSide::none || p.sides[1] == FaceSide::none || p.sides[0] == p.sides[1]) return false;
        auto a = faces[p.faces[0].cell][p.faces[0].face], b = faces[p.faces[1].cell][p.faces[1].face];
        for (auto* list : {&a, &b}) {
            for (std::uint32_t& v : *list) v = d.vertex_origins[v];
        }
        if (!is_turned(a, b, true)) return false;
    }
    if (!d.vertex_places.empty() && d.vertex_places.size() != nv) return false;
    for (const auto& p : d.vertex_places) {
        const std::size_t size = p.place == Data::Place::region    ? d.regions.size()
                                 : p.place == Data::Place::surface ? d.surfaces.size()
                                 : p.place == Data::Place::line    ? d.lines.size()
                                 : p.place == Data::Place::corner  ? d.corners.size()
                                                                   : 0;
        if (p.entity >= size) return false;
    }
    for (const Attribute& a : d.attributes) {
        std::size_t things = 1;
        if (a.location == AttributeLocation::point) things = nv;
        else if (a.location == AttributeLocation::cell) things = cells;
        else if (a.location != AttributeLocation::object) return false;
        if (a.components == 0 || value_count(a) != things * a.components) return false;
        if (!a.component_names.empty() && a.component_names.size() != a.components) return false;
    }
    return true;
}

// ---- corruption at random

class Spoiler {
public:
    explicit Spoiler(unsigned seed) : random_(seed) {}

    void spoil(Data& d) {
        switch (below(22)) {
            case 0:
                return number(d.cell_nodes);
            case 1:
                return number(d.cell_offsets);
            case 2:
                return number(d.cell_faces);
            case 3:
                return number(d.face_offsets);
            case 4:
                return number(d.face_nodes);
            case 5:
                return number(d.vertex_origins);
            case 6:
                return number(any(d.node_sets).nodes);
            case 7:
                return small(any(any(d.edge_sets).edges)[below(2)]);
            case 8:
                return small(any(any(d.face_sets).faces).cell);
            case 9:
                return small(any(any(d.face_sets).faces).face);
            case 10:
                return small(any(d.face_sets).surface);
            case 11:
                any(d.blocks).type =
                    std::array{CellType::wedge, CellType::triangle, CellType::polyhedron, CellType::quadratic_tetrahedron}[below(4)];
                return;
            case 12:
                return small(any(d.blocks).first);
            case 13:
                return small(any(d.blocks).count);
            case 14:
                return small(any(d.blocks).region);
            case 15:
                return place(any(d.vertex_places));
            case 16:
                return small(any(d.split_pairs).faces[below(2)].face);
            case 17:
                any(d.split_pairs).sides[below(2)] = static_cast<FaceSide>(below(5));
                return;
            case 18:
                any(d.vertices)[below(3)] = below(2) == 0 ? std::numeric_limits<double>::infinity() : 7.5;
                return;
            case 19:
                return values(any(d.attributes));
            case 20:
                std::swap(any(d.cell_nodes), any(d.cell_nodes));
                return;
            default:
                any(d.face_sets).name.clear();
                return;
        }
    }

private:
    std::mt19937 random_;

    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
    template <class List>
    typename List::value_type& any(List& list) {
        return list[below(list.size())];
    }
    template <class Number>
    void small(Number& n) {
        n = below(8) == 0 ? static_cast<Number>(-1) : static_cast<Number>(below(20));
    }
    template <class Number>
    void number(std::vector<Number>& list) {
        if (list.empty()) return;
        const std::size_t what = below(6);
        if (what == 0) list.pop_back();
        else if (what == 1) list.push_back(static_cast<Number>(below(20)));
        else small(any(list));
    }
    void place(Data::VertexPlace& p) {
        p.place = static_cast<Data::Place>(below(5));
        small(p.entity);
    }
    void values(Attribute& a) {
        if (below(2) == 0) a.components = static_cast<std::uint32_t>(below(4));
        else a.location = static_cast<AttributeLocation>(below(6));
    }
};

TEST(VolumeMesh, TakesWhatIsRight) {
    const auto mesh = VolumeMesh::make(hand_made());
    ASSERT_TRUE(mesh) << mesh.why().error.message;
    EXPECT_TRUE(slowly_right(hand_made()));
    EXPECT_TRUE(VolumeMesh::make({}));
    EXPECT_EQ(mesh->block_of(1).type, CellType::pyramid);
    EXPECT_EQ(mesh->block_of(3).region, 1u);
    EXPECT_EQ(mesh->nodes_of({3, 1}), (std::vector<std::uint32_t>{9, 10, 13}));
    EXPECT_EQ(mesh->nodes_of({0, 3}), (std::vector<std::uint32_t>{1, 2, 6, 5}));
}

// One to three things are changed at random: make() refuses exactly what the slow checker refuses.
TEST(VolumeMesh, RefusesExactlyWhatIsCorrupt) {
    int refused = 0, taken = 0;
    for (unsigned seed = 0; seed < test::seeds(20000); ++seed) {
        Data d = hand_made();
        Spoiler spoiler(seed);
        for (unsigned n = 0; n <= seed % 3; ++n) spoiler.spoil(d);
        const bool right = slowly_right(d);
        const auto made = VolumeMesh::make(d);
        ASSERT_EQ(made.ok(), right) << "seed " << seed << (made ? "" : ": " + made.why().error.message);
        ++(right ? taken : refused);
    }
    EXPECT_GT(refused, 200);
    EXPECT_GT(taken, 20) << "some changes do no harm";
}

TEST(VolumeMesh, RefusesACellInsideOutBesideAnother) {
    Data d = hand_made();
    std::swap(d.cell_nodes[9], d.cell_nodes[11]);  // the pyramid's base turns
    EXPECT_FALSE(VolumeMesh::make(d));
}

// ---- faces and edges of cell types

constexpr std::array volume_types{CellType::tetrahedron, CellType::pyramid,          CellType::wedge,
                                  CellType::hexahedron,  CellType::pentagonal_prism, CellType::hexagonal_prism};

TEST(CellFaces, CloseTheCellAndHaveItsEdges) {
    for (const CellType type : volume_types) {
        std::set<std::array<std::uint8_t, 2>> directed, edges;
        for (const LocalFace& face : faces_of(type)) {
            for (std::size_t i = 0; i < face.count; ++i) {
                const std::uint8_t p = face.corners()[i], q = face.corners()[(i + 1) % face.count];
                EXPECT_LT(p, node_count(type));
                EXPECT_TRUE(directed.insert({p, q}).second) << to_string(type);
                edges.insert({std::min(p, q), std::max(p, q)});
            }
        }
        for (const auto& [p, q] : directed) EXPECT_TRUE(directed.contains({q, p})) << to_string(type);
        EXPECT_EQ(std::vector(edges.begin(), edges.end()), std::vector(edges_of(type).begin(), edges_of(type).end())) << to_string(type);
        EXPECT_EQ(node_count(type) + faces_of(type).size(), edges.size() + 2) << "Euler";
    }
    EXPECT_TRUE(faces_of(CellType::triangle).empty());
    EXPECT_TRUE(edges_of(CellType::polyhedron).empty());
    EXPECT_EQ(faces_of(CellType::quadratic_hexahedron).size(), 6u);
}

TEST(CellFaces, PointOutOfReferenceCells) {
    const auto outward = [](CellType type, const std::vector<Vec3>& corners) {
        Vec3 centre{};
        for (const Vec3& p : corners) centre = plus(centre, times(1 / double(corners.size()), p));
        for (const LocalFace& face : faces_of(type)) {
            const Vec3 &a = corners[face.numbers[0]], &b = corners[face.numbers[1]], &c = corners[face.numbers[2]];
            EXPECT_GT(dot(cross(minus(b, a), minus(c, a)), minus(a, centre)), 0) << to_string(type);
        }
    };
    outward(CellType::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    outward(CellType::pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}});
    outward(CellType::wedge, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}});
    outward(CellType::hexahedron, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
}

// ---- needs of targets

TEST(MeshNeeds, RowsAreSortedAndSound) {
    const auto rows = mesh_needs();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_TRUE(i == 0 || rows[i - 1].target < rows[i].target);
        EXPECT_EQ(find_mesh_needs(rows[i].target), &rows[i]);
        EXPECT_TRUE(rows[i].order == 1 || rows[i].order == 2);
        EXPECT_TRUE(rows[i].face_sets || !rows[i].face_sides) << rows[i].target;
    }
    EXPECT_EQ(find_mesh_needs("no such target"), nullptr);
}

TEST(MeshNeeds, ListWhatIsLost) {
    const auto mesh = VolumeMesh::make(hand_made());
    ASSERT_TRUE(mesh);
    const auto has = [](const std::vector<Loss>& list, const std::string& entity, const std::string& what, LossClass loss_class) {
        return std::any_of(list.begin(), list.end(),
                           [&](const Loss& l) { return l.entity == entity && l.what == what && l.loss_class == loss_class; });
    };
    EXPECT_TRUE(losses(*mesh, *find_mesh_needs("vtk")).empty());
    const auto tetgen = losses(*mesh, *find_mesh_needs("tetgen"));
    EXPECT_TRUE(has(tetgen, "west", "cells: hexahedron", LossClass::substance));
    EXPECT_TRUE(has(tetgen, "west", "cells: pyramid", LossClass::substance));
    EXPECT_TRUE(has(tetgen, "east", "cells: polyhedron", LossClass::substance));
    EXPECT_FALSE(has(tetgen, "east", "cells: tetrahedron", LossClass::substance));
    EXPECT_TRUE(has(tetgen, "west", "name of the region", LossClass::identity));
    EXPECT_TRUE(has(tetgen, "well", "edge set", LossClass::substance));
    EXPECT_TRUE(has(tetgen, "", "attribute 'porosity'", LossClass::substance));
    EXPECT_FALSE(has(tetgen, "", "attribute 'speed'", LossClass::substance));
    EXPECT_TRUE(has(losses(*mesh, *find_mesh_needs("pflotran")), "fault_west", "side of faces", LossClass::identity));
    Data long_names = hand_made();
    long_names.regions[1] = "eastern";
    EXPECT_TRUE(
        has(losses(*VolumeMesh::make(long_names), *find_mesh_needs("tough2")), "eastern", "the end of the name", LossClass::identity));
}

}  // namespace
}  // namespace geomend
