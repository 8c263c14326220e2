// SPDX-License-Identifier: AGPL-3.0-or-later
// Valid models, damaged at random: Brep::make refuses them exactly when a slow reading of what its comment promises does.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "topology/brep_from_dataset.h"
#include "topology/model_maker.h"
#include "topology/several_meshes.h"

namespace geomend {
namespace {

// ---- what is promised, read slowly ----

bool below(std::uint64_t i, std::size_t n) { return i < n; }

bool offsets_promised(const std::vector<std::uint64_t>& offsets, std::size_t size) {
    if (offsets.empty() || offsets[0] != 0 || offsets[offsets.size() - 1] != size) return false;
    for (std::size_t i = 1; i < offsets.size(); ++i) {
        if (offsets[i] < offsets[i - 1]) return false;
    }
    return true;
}

bool adjacency_promised(const BrepData::Surface& s) {
    if (s.neighbours.empty()) return true;
    if (s.neighbours.size() != s.polygons.corners.size()) return false;
    struct Side {
        std::set<std::uint32_t> ends;
        std::uint32_t from, to;
    };
    std::vector<Side> sides;
    std::size_t at = 0;
    for (std::uint32_t p = 0; p < s.polygons.size(); ++p) {
        const auto polygon = s.polygons[p];
        for (std::size_t k = 0; k < polygon.size(); ++k, ++at) {
            const std::uint32_t q = s.neighbours[at];
            if (q == no_index) continue;
            if (!below(q, s.polygons.size()) || q == p) return false;
            sides.push_back({{polygon[k], polygon[(k + 1) % polygon.size()]}, p, q});
        }
    }
    return std::ranges::all_of(sides, [&](const Side& a) {
        return std::ranges::any_of(sides, [&](const Side& b) { return b.from == a.to && b.to == a.from && b.ends == a.ends; });
    });
}

bool attributes_promised(const std::vector<Attribute>& all, AttributeLocation location, std::size_t count) {
    return std::ranges::all_of(all, [&](const Attribute& a) { return a.location != location || value_count(a) == a.components * count; });
}

bool surface_promised(const BrepData& d, const BrepData::Surface& s) {
    for (const VertexId v : s.nodes) {
        if (!below(v.value, d.vertices.size())) return false;
    }
    if (s.polygons.offsets.empty() ? s.polygons.corners.size() % 3 != 0
                                   : !offsets_promised(s.polygons.offsets, s.polygons.corners.size())) {
        return false;
    }
    for (const std::uint32_t n : s.polygons.corners) {
        if (!below(n, s.nodes.size())) return false;
    }
    for (const auto& l : s.lines) {
        if (!below(l.line.value, d.lines.size())) return false;
    }
    for (const RegionId r : s.regions) {
        if (r.value != no_index && !below(r.value, d.regions.size())) return false;
    }
    if (s.interface_id.value != no_index && !below(s.interface_id.value, d.interfaces.size())) return false;
    return adjacency_promised(s) && attributes_promised(s.attributes, AttributeLocation::point, s.nodes.size()) &&
           attributes_promised(s.attributes, AttributeLocation::polygon, s.polygons.size());
}

bool region_promised(const BrepData& d, const BrepData::Region& r) {
    for (const auto& side : r.sides) {
        if (!below(side.surface.value, d.surfaces.size())) return false;
    }
    for (const VertexId v : r.nodes) {
        if (!below(v.value, d.vertices.size())) return false;
    }
    if (r.cell_offsets.size() != r.cell_types.size() + 1 || !offsets_promised(r.cell_offsets, r.cell_nodes.size())) return false;
    for (std::size_t c = 0; c < r.cell_types.size(); ++c) {
        const auto wanted = node_count(r.cell_types[c]);
        if (wanted > 0 && r.cell_offsets[c] + wanted != r.cell_offsets[c + 1]) return false;
    }
    for (const auto* nodes : {&r.cell_nodes, &r.face_nodes}) {
        for (const std::uint32_t n : *nodes) {
            if (!below(n, r.nodes.size())) return false;
        }
    }
    if (!r.cell_faces.empty() || !r.face_offsets.empty() || !r.face_nodes.empty()) {
        if (r.cell_faces.size() != r.cell_types.size() + 1 || !offsets_promised(r.face_offsets, r.face_nodes.size())) return false;
        if (!offsets_promised(r.cell_faces, r.face_offsets.size() - 1)) return false;
    }
    return attributes_promised(r.attributes, AttributeLocation::point, r.nodes.size()) &&
           attributes_promised(r.attributes, AttributeLocation::cell, r.cell_types.size());
}

bool lines_promised(const BrepData& d) {
    for (const auto& c : d.corners) {
        if (!below(c.vertex.value, d.vertices.size())) return false;
    }
    for (const auto& l : d.lines) {
        if (l.vertices.size() < 2) return false;
        for (const VertexId v : l.vertices) {
            if (!below(v.value, d.vertices.size())) return false;
        }
        for (const std::size_t end : {0u, 1u}) {
            if (!below(l.corners[end].value, d.corners.size())) return false;
            if (d.corners[l.corners[end].value].vertex != (end == 0 ? l.vertices[0] : l.vertices[l.vertices.size() - 1])) return false;
        }
        if (l.contact.value != no_index && !below(l.contact.value, d.contacts.size())) return false;
    }
    return true;
}

bool geology_promised(const BrepData& d) {
    const auto all_below = [](const auto& ids, std::size_t n) {
        return std::ranges::all_of(ids, [&](const auto& id) { return below(id.value, n); });
    };
    for (const auto& i : d.interfaces) {
        if (!all_below(i.surfaces, d.surfaces.size())) return false;
    }
    for (const auto& f : d.features) {
        if (!all_below(f.surfaces, d.surfaces.size())) return false;
    }
    for (const auto& c : d.contacts) {
        if (!all_below(c.lines, d.lines.size())) return false;
        for (std::size_t i = 0; i < c.interfaces.size(); ++i) {
            if (c.interfaces[i].value != no_index && !below(c.interfaces[i].value, d.interfaces.size())) return false;
            if (i > 0 && c.interfaces[i] < c.interfaces[i - 1]) return false;
        }
    }
    for (const auto& list : d.layers) {
        if (!all_below(list.regions, d.regions.size())) return false;
    }
    for (const auto& list : d.fault_blocks) {
        if (!all_below(list.regions, d.regions.size())) return false;
    }
    for (const auto& side : d.universe) {
        if (!below(side.surface.value, d.surfaces.size())) return false;
    }
    return true;
}

bool promised(const BrepData& d) {
    return lines_promised(d) && geology_promised(d) &&
           attributes_promised(d.vertex_attributes, AttributeLocation::point, d.vertices.size()) &&
           std::ranges::all_of(d.surfaces, [&](const auto& s) { return surface_promised(d, s); }) &&
           std::ranges::all_of(d.regions, [&](const auto& r) { return region_promised(d, r); });
}

// ---- valid models ----

Attribute counted_from_zero(const char* name, AttributeLocation location, std::size_t count) {
    Attribute a;
    a.name = name;
    a.location = location;
    a.components = 2;
    a.values = std::vector<double>(2 * count, 1.0);
    return a;
}

/// Everything that a model can have, whatever it means.
BrepData with_all_kinds(BrepData d) {
    d.vertex_attributes.push_back(counted_from_zero("v", AttributeLocation::point, d.vertices.size()));
    for (auto& s : d.surfaces) {
        s.attributes.push_back(counted_from_zero("n", AttributeLocation::point, s.nodes.size()));
        s.attributes.push_back(counted_from_zero("p", AttributeLocation::polygon, s.polygons.size()));
    }
    d.features.push_back({"all", {SurfaceId(0u), SurfaceId(d.surfaces.size() - 1)}});
    d.fault_blocks.push_back({"block", {RegionId(0u)}, {}});
    auto& r = d.regions[0];
    r.nodes = {VertexId(0u), VertexId(1u), VertexId(2u), VertexId(3u)};
    r.cell_types = {CellType::tetrahedron, CellType::polyhedron};
    r.cell_offsets = {0, 4, 8};
    r.cell_nodes = {0, 1, 2, 3, 0, 1, 2, 3};
    r.cell_faces = {0, 0, 4};
    r.face_offsets = {0, 3, 6, 9, 12};
    r.face_nodes = {0, 1, 2, 0, 1, 3, 1, 2, 3, 0, 2, 3};
    r.attributes = {counted_from_zero("c", AttributeLocation::cell, 2), counted_from_zero("r", AttributeLocation::point, 4)};
    return d;
}

const std::vector<BrepData>& valid_models() {
    static const std::vector<BrepData> models = [] {
        std::vector<BrepData> all;
        auto blocks = test::two_blocks();
        topology::build_breps(blocks.data);
        all.push_back(with_all_kinds(*blocks.data.breps.at(0)));
        Dataset meshes = test::model_over_two_meshes();
        topology::build_breps(meshes);
        all.push_back(*meshes.breps.at(0));
        test::ModelMaker shell;
        shell.add("box", FeatureRole::boundary, test::box({0, 0, 0}, {1, 1, 1}));
        topology::build_breps(shell.data);
        all.push_back(with_all_kinds(*shell.data.breps.at(0)));
        return all;
    }();
    return models;
}

// ---- damage ----

std::uint32_t any_number(std::size_t size) {
    const auto n = static_cast<std::uint32_t>(size);
    return *rc::gen::element(n, n + 1, no_index, no_index - 1, 0u, *rc::gen::inRange(0u, n + 2));
}

void damage_indices(std::vector<std::uint32_t>& v, std::size_t size) {
    if (!v.empty()) v[*rc::gen::inRange<std::size_t>(0, v.size())] = any_number(size);
}
template <class IdType>
void damage_ids(std::vector<IdType>& v, std::size_t size) {
    if (!v.empty()) v[*rc::gen::inRange<std::size_t>(0, v.size())] = IdType(any_number(size));
}
template <class T>
void change_length(std::vector<T>& v) {
    if (*rc::gen::arbitrary<bool>() && !v.empty()) v.pop_back();
    else v.push_back(v.empty() ? T{} : v.front());
}
void damage_offsets(std::vector<std::uint64_t>& v) {
    if (v.empty() || *rc::gen::inRange(0, 3) == 0) return change_length(v);
    v[*rc::gen::inRange<std::size_t>(0, v.size())] = *rc::gen::inRange<std::uint64_t>(0, v.back() + 3);
}
template <class T>
T* one_of(std::vector<T>& v) {
    return v.empty() ? nullptr : &v[*rc::gen::inRange<std::size_t>(0, v.size())];
}
void damage_attribute(std::vector<Attribute>& all) {
    if (auto* a = one_of(all)) {
        if (*rc::gen::arbitrary<bool>()) a->components = *rc::gen::inRange(1u, 4u);
        else change_length(std::get<std::vector<double>>(a->values));
    }
}

void damage_surface(BrepData& d, BrepData::Surface& s) {
    switch (*rc::gen::inRange(0, 12)) {
        case 0:
            return damage_ids(s.nodes, d.vertices.size());
        case 1:
            return damage_indices(s.polygons.corners, s.nodes.size());
        case 2:
            return damage_indices(s.neighbours, s.polygons.size());
        case 3:
            return change_length(s.polygons.corners);
        case 4:
            return change_length(s.neighbours);
        case 5:
            return damage_offsets(s.polygons.offsets);
        case 6:
            return damage_attribute(s.attributes);
        case 7:
            s.regions[*rc::gen::inRange(0, 2)] = RegionId(any_number(d.regions.size()));
            return;
        case 8:
            s.interface_id = InterfaceId(any_number(d.interfaces.size()));
            return;
        case 9:
            if (auto* l = one_of(s.lines)) l->line = LineId(any_number(d.lines.size()));
            return;
        case 10:
            if (s.neighbours.size() > 1) std::swap(*one_of(s.neighbours), *one_of(s.neighbours));
            return;
        default:
            return change_length(s.nodes);
    }
}

void damage_region(BrepData& d, BrepData::Region& r) {
    switch (*rc::gen::inRange(0, 11)) {
        case 0:
            return damage_ids(r.nodes, d.vertices.size());
        case 1:
            return damage_indices(r.cell_nodes, r.nodes.size());
        case 2:
            return damage_indices(r.face_nodes, r.nodes.size());
        case 3:
            return damage_offsets(r.cell_offsets);
        case 4:
            return damage_offsets(r.cell_faces);
        case 5:
            return damage_offsets(r.face_offsets);
        case 6:
            return change_length(r.cell_types);
        case 7:
            if (auto* t = one_of(r.cell_types)) *t = CellType::wedge;
            return;
        case 8:
            return damage_attribute(r.attributes);
        case 9:
            if (auto* side = one_of(r.sides)) side->surface = SurfaceId(any_number(d.surfaces.size()));
            return;
        default:
            return change_length(r.face_nodes);
    }
}

void damage_line(BrepData& d, BrepData::Line& l) {
    switch (*rc::gen::inRange(0, 4)) {
        case 0:
            return damage_ids(l.vertices, d.vertices.size());
        case 1:
            l.corners[*rc::gen::inRange(0, 2)] = CornerId(any_number(d.corners.size()));
            return;
        case 2:
            l.contact = ContactId(any_number(d.contacts.size()));
            return;
        default:
            return change_length(l.vertices);
    }
}

void damage_rest(BrepData& d) {
    switch (*rc::gen::inRange(0, 9)) {
        case 0:
            if (auto* c = one_of(d.corners)) c->vertex = VertexId(any_number(d.vertices.size()));
            return;
        case 1:
            if (auto* i = one_of(d.interfaces)) damage_ids(i->surfaces, d.surfaces.size());
            return;
        case 2:
            if (auto* f = one_of(d.features)) damage_ids(f->surfaces, d.surfaces.size());
            return;
        case 3:
            if (auto* c = one_of(d.contacts)) damage_ids(c->interfaces, d.interfaces.size());
            return;
        case 4:
            if (auto* c = one_of(d.contacts)) damage_ids(c->lines, d.lines.size());
            return;
        case 5:
            if (auto* l = one_of(d.layers)) damage_ids(l->regions, d.regions.size());
            return;
        case 6:
            if (auto* b = one_of(d.fault_blocks)) damage_ids(b->regions, d.regions.size());
            return;
        case 7:
            if (auto* side = one_of(d.universe)) side->surface = SurfaceId(any_number(d.surfaces.size()));
            return;
        default:
            return damage_attribute(d.vertex_attributes);
    }
}

TEST(BrepGate, LetsValidModelsThrough) {
    for (const BrepData& d : valid_models()) {
        EXPECT_TRUE(promised(d));
        EXPECT_TRUE(Brep::make(d));
    }
}

RC_GTEST_PROP(BrepGate, RefusesExactlyWhatBreaksAPromise, ()) {
    BrepData d = valid_models()[*rc::gen::inRange<std::size_t>(0, valid_models().size())];
    switch (*rc::gen::inRange(0, 4)) {
        case 0:
            damage_surface(d, *one_of(d.surfaces));
            break;
        case 1:
            damage_region(d, *one_of(d.regions));
            break;
        case 2:
            if (auto* l = one_of(d.lines)) damage_line(d, *l);
            break;
        default:
            damage_rest(d);
            break;
    }
    const bool valid = promised(d);
    RC_CLASSIFY(valid);
    RC_ASSERT(Brep::make(std::move(d)).ok() == valid);
}

TEST(BrepGate, RefusesNeighboursAcrossDifferentEdges) {
    BrepData d;
    d.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    auto& s = d.surfaces.emplace_back();
    for (std::uint32_t v = 0; v < 4; ++v) s.nodes.emplace_back(v);
    s.polygons.corners = {0, 1, 2, 1, 3, 2};
    const std::uint32_t n = no_index;
    s.neighbours = {n, 1, n, n, n, 0};
    EXPECT_TRUE(Brep::make(d));
    d.surfaces[0].neighbours = {n, 1, n, 0, n, n};  // each names the other, but across an edge that is not the other's
    EXPECT_FALSE(Brep::make(d));
}

}  // namespace
}  // namespace geomend
