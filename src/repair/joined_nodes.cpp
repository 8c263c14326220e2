// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/joined_nodes.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/vectors.h"
#include "model/attribute_operations.h"
#include "topology/weld.h"

namespace geomend::repair {

namespace {

std::size_t end_vertex(const SurfaceModel& model, std::size_t patch) {
    return patch + 1 < model.source_patches.size() ? model.source_patches[patch + 1].first_vertex : model.source.vertices.size();
}

std::size_t end_triangle(const SurfaceModel& model, std::size_t patch) {
    return patch + 1 < model.source_patches.size() ? model.source_patches[patch + 1].first_triangle : model.source.triangles.size();
}

/// The nodes of a stated face as they were read, and the places that they are at.
struct ReadFace {
    const SurfaceModel& model;
    std::uint32_t first_vertex;
    std::vector<std::uint32_t> place;  ///< per node
    std::vector<std::uint32_t> nodes;  ///< that triangles use, by place

    ReadFace(const SurfaceModel& m, std::size_t patch) : model(m), first_vertex(m.source_patches[patch].first_vertex) {
        topology::Welder welder(0);
        for (std::size_t v = first_vertex; v < end_vertex(m, patch); ++v) place.push_back(welder.add(m.source.vertices[v]));
        std::vector<std::uint8_t> used(place.size(), 0);
        for (std::size_t t = m.source_patches[patch].first_triangle; t < end_triangle(m, patch); ++t) {
            for (const std::uint32_t v : m.source.triangles[t]) used[v - first_vertex] = 1;
        }
        for (std::uint32_t n = 0; n < used.size(); ++n) {
            if (used[n] != 0) nodes.push_back(n);
        }
        std::ranges::stable_sort(nodes, {}, [&](std::uint32_t n) { return place[n]; });
    }
    bool has_twins() const {
        return std::ranges::adjacent_find(nodes, {}, [&](std::uint32_t n) { return place[n]; }) != nodes.end();
    }
    /// Per place whether a border runs through it twice, along one way: a cut.
    std::vector<std::uint8_t> cut_places(std::size_t patch) const {
        using Edge = std::pair<std::uint32_t, std::uint32_t>;
        std::vector<Edge> edges;
        for (std::size_t t = model.source_patches[patch].first_triangle; t < end_triangle(model, patch); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                edges.push_back(
                    std::minmax(model.source.triangles[t][k] - first_vertex, model.source.triangles[t][(k + 1) % 3] - first_vertex));
            }
        }
        std::ranges::sort(edges);
        std::map<Edge, std::uint32_t> borders;  // by places
        for (std::size_t i = 0; i < edges.size();) {
            std::size_t j = i + 1;
            while (j < edges.size() && edges[j] == edges[i]) ++j;
            if (j == i + 1) ++borders[std::minmax(place[edges[i].first], place[edges[i].second])];
            i = j;
        }
        std::vector<std::uint8_t> cut(place.size(), 0);
        for (const auto& [edge, count] : borders) {
            if (count > 1) cut[edge.first] = cut[edge.second] = 1;
        }
        return cut;
    }
};

bool same_values(const std::vector<Attribute>& attributes, std::uint32_t a, std::uint32_t b) {
    return std::ranges::all_of(attributes, [&](const Attribute& attribute) {
        if (attribute.location != AttributeLocation::point) return true;
        return std::visit(
            [&](const auto& values) {
                for (std::size_t c = 0; c < attribute.components; ++c) {
                    if (!same_value(values[a * attribute.components + c], values[b * attribute.components + c])) return false;
                }
                return true;
            },
            attribute.values);
    });
}

/// Where each corner of the soup's triangles was read: the node of the source that it is, or no_index where it was made.
class ReadCorners {
public:
    explicit ReadCorners(const SurfaceModel& model) : m_(model), near_(4 * model.lengths.tolerance) {}

    std::uint32_t node(std::uint32_t triangle, std::size_t corner) const {
        const std::uint32_t from = m_.origin.triangles[triangle];
        if (from == no_index) return no_index;
        const Vec3& position = m_.model.soup.vertices[m_.model.soup.triangles[triangle][corner]];
        std::uint32_t best = no_index;
        double least = near_ * near_;
        for (const std::uint32_t v : m_.source.triangles[from]) {
            const Vec3 off = minus(m_.source.vertices[v], position);
            if (dot(off, off) > least) continue;
            least = dot(off, off);
            best = v;
        }
        return best == no_index || m_.counts_as.empty() ? best : m_.counts_as[best];
    }
    const SurfaceModel::SourcePatch& patch_of(std::uint32_t node) const {
        const auto next = std::ranges::upper_bound(m_.source_patches, node, {}, &SurfaceModel::SourcePatch::first_vertex);
        return *std::prev(next);
    }

private:
    const SurfaceModel& m_;
    double near_;
};

/// A corner of a polygon at a vertex where its surface has several nodes.
struct TwinCorner {
    std::uint32_t vertex, surface, node, read;
    auto operator<=>(const TwinCorner&) const = default;
};

/// The corners at vertices where some surface has several nodes, and all that meets there was read there; by vertex and surface.
std::vector<TwinCorner> twin_corners(const SurfaceModel& model, const std::vector<std::vector<std::uint32_t>>& triangles,
                                     const BrepData& brep) {
    std::vector<std::uint8_t> wanted(brep.vertices.size(), 0);
    std::vector<std::uint32_t> owner(brep.vertices.size(), no_index);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const VertexId v : brep.surfaces[s].nodes) {
            if (owner[v.value] == s) wanted[v.value] = 1;
            owner[v.value] = s;
        }
    }
    const ReadCorners read(model);
    std::vector<TwinCorner> corners;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
            const auto& triangle = model.model.soup.triangles[triangles[s][p]];
            for (const std::uint32_t node : surface.polygons[p]) {
                const std::uint32_t v = surface.nodes[node].value;
                if (wanted[v] == 0) continue;
                const auto here =
                    std::ranges::find_if(triangle, [&](std::uint32_t own) { return model.model.soup.vertices[own] == brep.vertices[v]; });
                const auto k = static_cast<std::size_t>(here - triangle.begin());
                corners.push_back({v, s, node, k < 3 ? read.node(triangles[s][p], k) : no_index});
            }
        }
    }
    for (const TwinCorner& c : corners) {
        if (c.read == no_index) wanted[c.vertex] = 0;
    }
    std::erase_if(corners, [&](const TwinCorner& c) { return wanted[c.vertex] == 0; });
    std::ranges::sort(corners);
    return corners;
}

/// Whether loose surfaces double nodes where they are cut: at most places where one lies on several sides of a line.
bool loose_surfaces_state_cuts(const ReadCorners& read, std::span<const TwinCorner> corners) {
    std::size_t doubled = 0, single = 0;
    for (std::size_t i = 0, j = 0; i < corners.size(); i = j) {
        bool nodes_differ = false, read_differ = false;
        for (j = i; j < corners.size() && corners[j].vertex == corners[i].vertex && corners[j].surface == corners[i].surface; ++j) {
            nodes_differ |= corners[j].node != corners[i].node;
            read_differ |= corners[j].read != corners[i].read;
        }
        if (!nodes_differ || read.patch_of(corners[i].read).cuts != SurfaceModel::SourcePatch::if_most) continue;
        ++(read_differ ? doubled : single);
    }
    return doubled > single;
}

/// The nodes of a surface that are left once some have become one.
void renumber_nodes(DisjointSets& sets, BrepData::Surface& surface) {
    std::vector<std::uint32_t> number(surface.nodes.size(), no_index);
    std::vector<VertexId> nodes;
    for (std::uint32_t n = 0; n < number.size(); ++n) {
        if (sets.root(n) != n) continue;
        number[n] = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(surface.nodes[n]);
    }
    for (std::uint32_t& corner : surface.polygons.corners) corner = number[sets.root(corner)];
    surface.nodes = std::move(nodes);
}

}  // namespace

LoneTwins join_lone_twins(SurfaceModel& model) {
    LoneTwins found;
    for (std::uint32_t p = 0; p < model.source_patches.size(); ++p) {
        if (model.source_patches[p].cuts != SurfaceModel::SourcePatch::stated) continue;
        const ReadFace face(model, p);
        if (!face.has_twins()) continue;
        const auto cut = face.cut_places(p);
        std::uint32_t lone = no_index;
        std::vector<std::array<std::uint32_t, 2>> joins;
        for (std::size_t i = 1; i < face.nodes.size(); ++i) {
            const std::uint32_t a = face.nodes[i - 1], b = face.nodes[i];
            if (face.place[a] != face.place[b]) continue;
            if (cut[face.place[a]] == 0 && lone == no_index) lone = a;
            if (same_values(model.source_patches[p].attributes, a, b)) joins.push_back({a, b});
        }
        if (lone == no_index || joins.empty()) continue;
        if (found.faces.empty()) found.where = model.source.vertices[face.first_vertex + lone];
        found.faces.push_back(p);
        found.nodes += joins.size();
        if (model.counts_as.empty()) {
            model.counts_as.resize(model.source.vertices.size());
            std::iota(model.counts_as.begin(), model.counts_as.end(), 0u);
        }
        for (const auto& [a, b] : joins) model.counts_as[face.first_vertex + b] = model.counts_as[face.first_vertex + a];
    }
    return found;
}

bool join_nodes_as_read(const SurfaceModel& model, const std::vector<std::vector<std::uint32_t>>& triangles, BrepData& brep) {
    const auto corners = twin_corners(model, triangles, brep);
    if (corners.empty()) return false;
    const ReadCorners read(model);
    const bool loose_state = loose_surfaces_state_cuts(read, corners);
    const auto states = [&](std::uint32_t node) {
        const auto cuts = read.patch_of(node).cuts;
        return cuts == SurfaceModel::SourcePatch::stated || (loose_state && cuts == SurfaceModel::SourcePatch::if_most);
    };
    bool any = false;
    std::map<std::uint32_t, DisjointSets> sets;                           // per surface
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> at;  // node of the result by vertex and node that was read
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const TwinCorner& c = corners[i];
        if (i == 0 || corners[i - 1].vertex != c.vertex || corners[i - 1].surface != c.surface) at.clear();
        const auto [first, is_new] = at.emplace(std::pair{c.vertex, c.read}, c.node);
        if (is_new || first->second == c.node || !states(c.read)) continue;
        sets.try_emplace(c.surface, brep.surfaces[c.surface].nodes.size()).first->second.join(first->second, c.node);
        any = true;
    }
    for (auto& [s, joined] : sets) renumber_nodes(joined, brep.surfaces[s]);
    return any;
}

}  // namespace geomend::repair
