// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/cut_nodes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "topology/face_edges.h"
#include "topology/faces_from_surfaces.h"

namespace geomend::topology {

namespace {

/// Nodes of the surface on lines that run inside it, and are not only embedded.
std::vector<std::uint8_t> nodes_on_cuts(const BrepData& brep, std::span<const std::uint8_t> embedded, const BrepData::Surface& surface) {
    std::unordered_map<std::uint32_t, std::uint8_t> vertices;
    for (const auto& use : surface.lines) {
        if (!use.internal || embedded[use.line.value] != 0) continue;
        for (const VertexId v : brep.lines[use.line.value].vertices) vertices.emplace(v.value, 1);
    }
    if (vertices.empty()) return {};
    std::vector<std::uint8_t> on_cut(surface.nodes.size(), 0);
    for (std::size_t n = 0; n < on_cut.size(); ++n) on_cut[n] = vertices.contains(surface.nodes[n].value) ? 1 : 0;
    return on_cut;
}

std::uint64_t key_of(VertexId a, VertexId b) { return std::uint64_t{std::min(a.value, b.value)} << 32U | std::max(a.value, b.value); }

/// Edges of lines that are only embedded in the surface.
std::unordered_set<std::uint64_t> embedded_edges(const BrepData& brep, std::span<const std::uint8_t> embedded,
                                                 const BrepData::Surface& surface) {
    std::unordered_set<std::uint64_t> all;
    for (const auto& use : surface.lines) {
        if (embedded[use.line.value] == 0) continue;
        const auto& vertices = brep.lines[use.line.value].vertices;
        for (std::size_t i = 1; i < vertices.size(); ++i) all.insert(key_of(vertices[i - 1], vertices[i]));
    }
    return all;
}

/// Joins the corners at both ends of each edge on an embedded line.
void join_across(const BrepData::Surface& surface, const PolygonEdges& edges, const std::unordered_set<std::uint64_t>& embedded,
                 DisjointSets& fan_of) {
    std::unordered_map<std::uint64_t, std::uint32_t> first;  // per edge the corner met first
    for (std::uint32_t c = 0; c < surface.neighbours.size() && !embedded.empty(); ++c) {
        if (surface.neighbours[c] != no_index) continue;
        const std::uint32_t from = edges.start_node(c), to = edges.end_node(c);
        if (!embedded.contains(key_of(surface.nodes[from], surface.nodes[to]))) continue;
        const std::uint64_t edge = std::uint64_t{std::min(from, to)} << 32U | std::max(from, to);
        const auto [at, is_new] = first.emplace(edge, c);
        if (is_new) continue;
        for (const std::uint32_t mine : {c, edges.next(c)}) {
            for (const std::uint32_t other : {at->second, edges.next(at->second)}) {
                if (surface.polygons.corners[mine] == surface.polygons.corners[other]) fan_of.join(mine, other);
            }
        }
    }
}

/// Corners of neighbouring polygons at one node belong to one fan.
DisjointSets fans(const BrepData::Surface& surface, const PolygonEdges& edges) {
    DisjointSets fan_of(surface.polygons.corners.size());
    for (std::uint32_t c = 0; c < fan_of.size(); ++c) {
        const std::uint32_t q = surface.neighbours[c];
        if (q == no_index) continue;
        const auto other = surface.polygons[q];
        const auto first = static_cast<std::uint32_t>(other.data() - surface.polygons.corners.data());
        for (const std::uint32_t mine : {c, edges.next(c)}) {
            for (std::uint32_t k = 0; k < other.size(); ++k) {
                if (other[k] == surface.polygons.corners[mine]) fan_of.join(mine, first + k);
            }
        }
    }
    return fan_of;
}

}  // namespace

void split_nodes_along_cuts(const BrepData& brep, std::span<const std::uint8_t> embedded, BrepData::Surface& surface) {
    const auto on_cut = nodes_on_cuts(brep, embedded, surface);
    if (on_cut.empty()) return;
    const PolygonEdges edges(surface.polygons);
    auto fan_of = fans(surface, edges);
    join_across(surface, edges, embedded_edges(brep, embedded, surface), fan_of);
    std::vector<std::uint32_t> source(surface.nodes.size());  // where each node's values come from
    std::iota(source.begin(), source.end(), 0u);
    std::vector<std::uint32_t> first_fan(surface.nodes.size(), no_index);
    std::unordered_map<std::uint32_t, std::uint32_t> node_of_fan;
    auto corners = surface.polygons.corners;
    for (std::uint32_t c = 0; c < corners.size(); ++c) {
        const std::uint32_t node = surface.polygons.corners[c];
        if (on_cut[node] == 0) continue;
        const std::uint32_t fan = fan_of.root(c);
        if (first_fan[node] == no_index) first_fan[node] = fan;
        if (first_fan[node] == fan) continue;
        const auto [at, is_new] = node_of_fan.emplace(fan, static_cast<std::uint32_t>(source.size()));
        if (is_new) source.push_back(node);
        corners[c] = at->second;
    }
    if (source.size() == surface.nodes.size()) return;
    surface.polygons.corners = std::move(corners);
    for (std::size_t n = surface.nodes.size(); n < source.size(); ++n) surface.nodes.push_back(surface.nodes[source[n]]);
    for (Attribute& a : surface.attributes) {
        if (a.location == AttributeLocation::point) a = restricted(a, source, a.location);
    }
}

}  // namespace geomend::topology
