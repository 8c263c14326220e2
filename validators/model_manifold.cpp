// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <tuple>

#include "topology/face_edges.h"
#include "validators/each_surface.h"
#include "validators/found_cells.h"
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
    std::uint32_t vertex, polygon, corner;
};

/// Whether the polygons around one vertex hang together by the edges at the vertex.
bool one_ring(const BrepData::Surface& surface, std::span<const PolygonAt> around) {
    std::vector<std::uint8_t> seen(around.size(), 0);
    std::vector<std::size_t> stack{0};
    seen[0] = 1;
    std::size_t reached = 0;
    while (!stack.empty()) {
        const PolygonAt& here = around[stack.back()];
        stack.pop_back();
        ++reached;
        const std::size_t first = surface.polygons.first_corner(here.polygon), size = surface.polygons[here.polygon].size();
        const std::size_t before = here.corner == first ? first + size - 1 : here.corner - 1;
        for (const std::uint32_t q : {surface.neighbours[here.corner], surface.neighbours[before]}) {
            for (std::size_t k = 0; q != no_index && k < around.size(); ++k) {
                if (around[k].polygon != q || seen[k] != 0) continue;
                seen[k] = 1;
                stack.push_back(k);
            }
        }
    }
    return reached == around.size();
}

/// Vertices away from lines where the polygons make more than one ring.
std::vector<std::uint32_t> pinched_vertices(const ModelScope& scope, const BrepData::Surface& surface, const topology::FaceEdges& face) {
    const auto aside = set_aside(scope, surface);
    std::vector<std::uint8_t> skip(surface.polygons.size(), 0);
    for (const std::uint32_t p : face.degenerate) skip[p] = 1;
    for (const std::uint32_t p : face.duplicate) skip[p] = 1;
    std::vector<PolygonAt> corners;
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
        if (skip[p] != 0) continue;
        const auto polygon = surface.polygons[p];
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            if (aside[polygon[i]] == 0)
                corners.push_back({surface.nodes[polygon[i]].value, p, static_cast<std::uint32_t>(surface.polygons.first_corner(p) + i)});
        }
    }
    std::ranges::sort(corners,
                      [](const PolygonAt& a, const PolygonAt& b) { return std::tie(a.vertex, a.corner) < std::tie(b.vertex, b.corner); });
    std::vector<std::uint32_t> pinched;
    for (std::size_t i = 0; i < corners.size();) {
        std::size_t j = i + 1;
        while (j < corners.size() && corners[j].vertex == corners[i].vertex) ++j;
        if (!one_ring(surface, std::span(corners).subspan(i, j - i))) pinched.push_back(corners[i].vertex);
        i = j;
    }
    return pinched;
}

}  // namespace

void check_manifold(const ModelScope& scope, std::vector<Finding>& findings) {
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        const topology::PolygonEdges edges(surface.polygons);
        const auto crowded = crowded_corners(surface, scope.model().faces[s], edges);
        const auto pinched = pinched_vertices(scope, surface, scope.model().faces[s]);
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

}  // namespace geomend::validators
