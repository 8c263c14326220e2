// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/new_brep.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/disjoint_sets.h"
#include "exchange/empty_regions.h"
#include "model/attribute_operations.h"

namespace geomend::remeshing {

namespace {

/// The values of a surface at its new nodes and triangles.
void carry_values(const BrepData::Surface& old, const NewSurface& made, std::span<const std::uint32_t> vertex_of_node,
                  BrepData::Surface& surface) {
    std::vector<Sample> samples;
    for (const std::uint32_t v : vertex_of_node) samples.push_back({made.sources[v].rows, made.sources[v].weights});
    surface.attributes.clear();
    for (const Attribute& a : old.attributes) {
        if (a.location == AttributeLocation::point) surface.attributes.push_back(interpolated(a, samples));
        else if (a.location == AttributeLocation::polygon) surface.attributes.push_back(taken(a, made.source_triangles));
        else surface.attributes.push_back(a);
    }
}

using Ends = std::pair<std::uint32_t, std::uint32_t>;

/// Edges of the lines that are creases, by the names of their ends, the lower one first.
std::set<Ends> crease_edges(const BrepData& brep, const LinePlan& lines) {
    std::set<Ends> edges;
    for (auto l = static_cast<std::uint32_t>(brep.lines.size()); l < lines.size(); ++l) {
        const auto samples = lines.samples(l);
        for (std::size_t k = 1; k < samples.size(); ++k) edges.insert(std::minmax(samples[k - 1].name, samples[k].name));
    }
    return edges;
}

/// Triangles are neighbours again across what was cut only to be remeshed, and have vertices in common there.
void close_creases(const NewSurface& made, const std::set<Ends>& creases, std::vector<std::uint32_t>& neighbours, DisjointSets& nodes) {
    std::map<Ends, std::uint32_t> open;
    for (std::uint32_t h = 0; h < made.corners.size(); ++h) {
        const std::uint32_t a = made.names[made.corners[h]], b = made.names[made.corners[next_of(h)]];
        if (neighbours[h] == no_index && a != no_index && b != no_index && creases.contains(std::minmax(a, b))) open.emplace(Ends(a, b), h);
    }
    for (const auto& [ends, h] : open) {
        const auto back = open.find({ends.second, ends.first});
        if (back == open.end()) continue;
        neighbours[h] = back->second / 3;
        nodes.join(made.corners[h], made.corners[next_of(back->second)]);
        nodes.join(made.corners[next_of(h)], made.corners[back->second]);
    }
}

void put_surface(const NewSurface& made, std::span<const std::uint32_t> number, const std::set<Ends>& creases,
                 const std::set<std::uint32_t>& corners, BrepData::Surface& surface) {
    const BrepData::Surface old = std::move(surface);
    surface = {};
    surface.name = old.name;
    surface.interface_id = old.interface_id;
    surface.role = old.role;
    surface.role_text = old.role_text;
    surface.lines = old.lines;
    surface.regions = old.regions;
    surface.source_object = old.source_object;
    surface.source_part = old.source_part;
    surface.annotations = old.annotations;
    surface.neighbours = made.neighbours;
    DisjointSets nodes(made.names.size());
    close_creases(made, creases, surface.neighbours, nodes);
    // Corners have one node where they had one. Other vertices of lines have a node on each side: it is a cut then.
    std::map<Ends, std::uint32_t> first_at;
    for (std::uint32_t v = 0; v < made.names.size(); ++v) {
        if (corners.contains(made.names[v])) nodes.join(v, first_at.emplace(Ends(made.names[v], made.nodes[v][0]), v).first->second);
    }
    std::vector<std::uint32_t> node_of(made.names.size(), no_index), vertex_of_node;
    for (std::uint32_t v = 0; v < made.names.size(); ++v) {
        std::uint32_t& node = node_of[nodes.root(v)];
        if (node == no_index) {
            node = static_cast<std::uint32_t>(surface.nodes.size());
            surface.nodes.push_back(VertexId(number[v]));
            vertex_of_node.push_back(v);
        }
    }
    for (const std::uint32_t v : made.corners) surface.polygons.corners.push_back(node_of[nodes.root(v)]);
    carry_values(old, made, vertex_of_node, surface);
}

}  // namespace

NewVertices new_vertices(const BrepData& brep, const LinePlan& lines, std::span<const NewSurface> surfaces) {
    NewVertices made;
    const auto use = [&](std::uint32_t name) {
        if (name == no_index) return;
        if (name >= made.number.size()) made.number.resize(std::max<std::size_t>(name + std::size_t{1}, brep.vertices.size()), no_index);
        made.number[name] = 0;
    };
    for (const auto& corner : brep.corners) use(corner.vertex.value);
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        for (const auto& named : lines.samples(l)) use(named.name);
    }
    for (const NewSurface& s : surfaces) std::ranges::for_each(s.names, use);
    for (std::uint32_t name = 0; name < made.number.size(); ++name) {
        if (made.number[name] == no_index) continue;
        made.number[name] = static_cast<std::uint32_t>(made.places.size());
        made.places.push_back(lines.place(name));
    }
    for (const NewSurface& s : surfaces) {
        auto& of = made.of.emplace_back();
        for (std::uint32_t v = 0; v < s.names.size(); ++v) {
            if (s.names[v] != no_index) of.push_back(made.number[s.names[v]]);
            else {
                of.push_back(static_cast<std::uint32_t>(made.places.size()));
                made.places.push_back(s.places[v]);
            }
        }
    }
    return made;
}

BrepData new_brep(const BrepData& brep, const LinePlan& lines, std::span<const NewSurface> surfaces, std::vector<Loss>& losses) {
    NewVertices vertices = new_vertices(brep, lines, surfaces);
    BrepData made = brep;
    exchange::empty_regions(made, LossClass::substance, "the surfaces around them are new", losses);
    for (auto& corner : made.corners) corner.vertex = VertexId(vertices.number[corner.vertex.value]);
    for (std::uint32_t l = 0; l < made.lines.size(); ++l) {
        made.lines[l].vertices.clear();
        for (const auto& named : lines.samples(l)) made.lines[l].vertices.push_back(VertexId(vertices.number[named.name]));
    }
    const auto creases = crease_edges(brep, lines);
    std::set<std::uint32_t> corners;
    for (const auto& corner : brep.corners) corners.insert(corner.vertex.value);
    for (std::uint32_t s = 0; s < made.surfaces.size(); ++s) {
        if (surfaces[s].kept) {
            for (std::uint32_t n = 0; n < made.surfaces[s].nodes.size(); ++n) made.surfaces[s].nodes[n] = VertexId(vertices.of[s][n]);
        } else {
            put_surface(surfaces[s], vertices.of[s], creases, corners, made.surfaces[s]);
        }
    }
    made.vertices = std::move(vertices.places);
    return made;
}

}  // namespace geomend::remeshing
