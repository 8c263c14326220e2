// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "topology/face_edges.h"
#include "validators/each_surface.h"
#include "validators/found_cells.h"
#include "validators/loose_manifold.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

/// Corners that start an edge which more than two polygons of the surface share.
std::vector<std::uint32_t> crowded_corners(const BrepData::Surface& surface, const topology::FaceEdges& face,
                                           const topology::PolygonEdges& edges) {
    struct Use {
        std::uint32_t low, high, corner;
    };
    std::vector<Use> uses;
    for (const std::uint32_t corner : face.border) {
        const std::uint32_t a = surface.nodes[edges.start_node(corner)].value, b = surface.nodes[edges.end_node(corner)].value;
        uses.push_back({std::min(a, b), std::max(a, b), corner});
    }
    std::ranges::sort(uses,
                      [](const Use& x, const Use& y) { return std::tie(x.low, x.high, x.corner) < std::tie(y.low, y.high, y.corner); });
    std::vector<std::uint32_t> crowded;
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t j = i + 1;
        while (j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high) ++j;
        for (std::size_t k = i; j - i > 2 && k < j; ++k) crowded.push_back(uses[k].corner);
        i = j;
    }
    return crowded;
}

/// Nodes on the surface's own lines, and nodes of polygons that have no neighbours by rule.
std::vector<std::uint8_t> set_aside(const ModelScope& scope, const BrepData::Surface& surface) {
    std::vector<std::uint32_t> on_lines;
    for (const auto& use : surface.lines) {
        for (const VertexId v : scope.brep().lines[use.line.value].vertices) on_lines.push_back(v.value);
    }
    std::ranges::sort(on_lines);
    std::vector<std::uint8_t> aside(surface.nodes.size());
    for (std::size_t n = 0; n < aside.size(); ++n) aside[n] = std::ranges::binary_search(on_lines, surface.nodes[n].value) ? 1 : 0;
    return aside;
}

/// A polygon at a vertex.
struct PolygonAt {
    std::uint32_t polygon, corner;
};

/// The polygons at each vertex of a surface, in the order of their corners; vertices by rank, the lowest number first.
struct PolygonsAround {
    std::vector<std::uint32_t> vertices;  ///< by rank
    std::vector<std::uint32_t> first;     ///< by rank, where its polygons begin; one more behind the last
    std::vector<PolygonAt> polygons;
};

template <class Body>
void each_corner(const BrepData::Surface& surface, const topology::FaceEdges& face, std::span<const std::uint8_t> aside, const Body& body) {
    std::vector<std::uint8_t> skip(surface.polygons.size(), 0);
    for (const std::uint32_t p : face.degenerate) skip[p] = 1;
    for (const std::uint32_t p : face.duplicate) skip[p] = 1;
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
        if (skip[p] != 0) continue;
        const auto polygon = surface.polygons[p];
        const auto first = static_cast<std::uint32_t>(surface.polygons.first_corner(p));
        for (std::uint32_t i = 0; i < polygon.size(); ++i) {
            if (aside[polygon[i]] == 0) body(polygon[i], PolygonAt{p, first + i});
        }
    }
}

// Several nodes may have one vertex.
std::vector<std::uint32_t> rank_nodes(const BrepData::Surface& surface, std::vector<std::uint32_t>& vertices) {
    vertices.clear();
    for (const VertexId v : surface.nodes) vertices.push_back(v.value);
    std::ranges::sort(vertices);
    vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
    std::vector<std::uint32_t> rank(surface.nodes.size());
    for (std::size_t n = 0; n < rank.size(); ++n)
        rank[n] = static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, surface.nodes[n].value) - vertices.begin());
    return rank;
}

PolygonsAround polygons_around(const BrepData::Surface& surface, const topology::FaceEdges& face, std::span<const std::uint8_t> aside) {
    PolygonsAround around;
    const std::vector<std::uint32_t> rank = rank_nodes(surface, around.vertices);
    around.first.assign(around.vertices.size() + 1, 0);
    each_corner(surface, face, aside, [&](std::uint32_t node, const PolygonAt&) { ++around.first[rank[node] + 1]; });
    for (std::size_t r = 1; r < around.first.size(); ++r) around.first[r] += around.first[r - 1];
    around.polygons.resize(around.first.back());
    std::vector<std::uint32_t> next = around.first;
    each_corner(surface, face, aside, [&](std::uint32_t node, const PolygonAt& at) { around.polygons[next[rank[node]]++] = at; });
    return around;
}

/// Buffers of one_ring(), used again from vertex to vertex.
struct RingWalk {
    std::vector<std::uint8_t> seen;
    std::vector<std::size_t> stack;
};

/// Whether the polygons around one vertex hang together by the edges at the vertex.
bool one_ring(const BrepData::Surface& surface, std::span<const PolygonAt> around, RingWalk& walk) {
    walk.seen.assign(around.size(), 0);
    walk.stack.assign(1, 0);
    walk.seen[0] = 1;
    std::size_t reached = 0;
    while (!walk.stack.empty()) {
        const PolygonAt& here = around[walk.stack.back()];
        walk.stack.pop_back();
        ++reached;
        const std::size_t first = surface.polygons.first_corner(here.polygon), size = surface.polygons[here.polygon].size();
        const std::size_t before = here.corner == first ? first + size - 1 : here.corner - 1;
        for (const std::uint32_t q : {surface.neighbours[here.corner], surface.neighbours[before]}) {
            for (std::size_t k = 0; q != no_index && k < around.size(); ++k) {
                if (around[k].polygon != q || walk.seen[k] != 0) continue;
                walk.seen[k] = 1;
                walk.stack.push_back(k);
            }
        }
    }
    return reached == around.size();
}

/// Vertices away from lines where the polygons make more than one ring.
std::vector<std::uint32_t> pinched_vertices(const ModelScope& scope, const BrepData::Surface& surface, const topology::FaceEdges& face) {
    const PolygonsAround around = polygons_around(surface, face, set_aside(scope, surface));
    std::vector<std::uint32_t> pinched;
    RingWalk walk;
    for (std::size_t r = 0; r < around.vertices.size(); ++r) {
        const auto here = std::span(around.polygons).subspan(around.first[r], around.first[r + 1] - around.first[r]);
        if (!here.empty() && !one_ring(surface, here, walk)) pinched.push_back(around.vertices[r]);
    }
    return pinched;
}

/// B03 of the surfaces of a model that a file states: each is to be manifold away from lines.
void report_stated_manifold(const ModelScope& scope, const std::vector<std::vector<std::uint32_t>>& all_pinched,
                            std::vector<Finding>& findings) {
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        const topology::PolygonEdges edges(surface.polygons);
        const auto crowded = crowded_corners(surface, scope.model().faces[s], edges);
        const auto& pinched = all_pinched[s];
        if (crowded.empty() && pinched.empty()) return std::nullopt;
        std::vector<std::uint32_t> polygons;
        for (const std::uint32_t corner : crowded) polygons.push_back(edges.polygon(corner));
        std::ranges::sort(polygons);
        polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
        std::string what;
        if (!crowded.empty()) what = counted(polygons.size(), "triangle", "triangles") + " at edges that more than two share";
        if (!pinched.empty())
            what += (what.empty() ? "" : ", and ") + counted(pinched.size(), "point", "points") + " where it only touches itself";
        Finding finding = polygons_finding(scope, "B03", s, quoted(surface.name) + " is not manifold: " + what, polygons);
        for (const std::uint32_t corner : crowded) {
            if (finding.polylines.size() >= listed_elements) break;
            finding.polylines.push_back(
                {scope.vertex_of_node(surface, edges.start_node(corner)), scope.vertex_of_node(surface, edges.end_node(corner))});
        }
        finding.points.clear();
        for (const std::uint32_t v : pinched) {
            if (finding.points.size() < listed_elements) finding.points.push_back(scope.brep().vertices[v]);
        }
        finding.count = polygons.size() + pinched.size();
        finding.measures = {{"edges_shared_by_more_than_two", static_cast<double>(crowded.size())},
                            {"pinched_points", static_cast<double>(pinched.size())}};
        return finding;
    });
}

}  // namespace

void check_manifold(const ModelScope& scope, std::vector<Finding>& findings) {
    std::vector<std::vector<std::uint32_t>> pinched(scope.brep().surfaces.size());
    parallel_for_each_index(pinched.size(), [&](std::size_t s) {
        if (!scope.stopped()) pinched[s] = pinched_vertices(scope, scope.brep().surfaces[s], scope.model().faces[s]);
    });
    if (scope.model().stated) report_stated_manifold(scope, pinched, findings);
    else report_loose_manifold(scope, pinched, findings);
}

}  // namespace geomend::validators
