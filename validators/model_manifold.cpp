// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "topology/face_edges.h"
#include "validators/cell_findings.h"
#include "validators/each_surface.h"
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

/// The vertices that lie on lines: 1.
std::vector<std::uint8_t> vertices_on_lines(const BrepData& brep) {
    std::vector<std::uint8_t> on_line(brep.vertices.size(), 0);
    for (const auto& line : brep.lines) {
        for (const VertexId v : line.vertices) on_line[v.value] = 1;
    }
    return on_line;
}

/// Nodes on the surface's own lines.
/// \param on_any_line of all vertices: those on the lines of whatever surface
std::vector<std::uint8_t> set_aside(const ModelScope& scope, const BrepData::Surface& surface, std::span<const std::uint8_t> on_any_line) {
    std::vector<std::uint32_t> on_lines;
    for (const auto& use : surface.lines) {
        for (const VertexId v : scope.brep().lines[use.line.value].vertices) on_lines.push_back(v.value);
    }
    std::ranges::sort(on_lines);
    std::vector<std::uint8_t> aside(surface.nodes.size());
    for (std::size_t n = 0; n < aside.size(); ++n) {
        const std::uint32_t v = surface.nodes[n].value;
        aside[n] = on_any_line[v] != 0 && std::ranges::binary_search(on_lines, v) ? 1 : 0;
    }
    return aside;
}

/// The corners at each node of a surface, of polygons that are judged: how many, and one of them.
struct CornersAt {
    std::vector<std::uint32_t> count, any;  ///< per node
};

CornersAt corners_at(const BrepData::Surface& surface, const topology::FaceEdges& face, std::span<const std::uint8_t> aside) {
    CornersAt at{std::vector<std::uint32_t>(surface.nodes.size()), std::vector<std::uint32_t>(surface.nodes.size())};
    std::vector<std::uint8_t> skip(surface.polygons.size(), 0);
    for (const std::uint32_t p : face.degenerate) skip[p] = 1;
    for (const std::uint32_t p : face.duplicate) skip[p] = 1;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        if (skip[p] != 0) continue;
        for (std::size_t c = surface.polygons.first_corner(p); c < surface.polygons.first_corner(p + 1); ++c) {
            const std::uint32_t node = surface.polygons.corners[c];
            if (aside[node] != 0) continue;
            ++at.count[node];
            at.any[node] = static_cast<std::uint32_t>(c);
        }
    }
    return at;
}

/// Walks around a node from polygon to polygon over the edges at it.
class RingWalk {
public:
    RingWalk(const BrepData::Surface& surface, const topology::PolygonEdges& edges) : surface_(surface), edges_(edges) {}

    /// How many polygons hang together with that of a corner, itself included; `most` where there are more.
    std::uint32_t size(std::uint32_t corner, std::uint32_t most) const {
        std::uint32_t reached = 1;
        for (const bool over_start : {true, false}) {
            std::uint32_t here = corner, edge = over_start ? corner : before(corner);
            while (reached <= most) {
                const std::uint32_t next = surface_.neighbours[edge];
                if (next == no_index) break;
                here = corner_of(next, surface_.polygons.corners[corner]);
                if (here == corner) return reached;  // all around
                edge = is_same_edge(here, edge) ? before(here) : here;
                ++reached;
            }
        }
        return std::min(reached, most);
    }

private:
    const BrepData::Surface& surface_;
    const topology::PolygonEdges& edges_;

    std::uint32_t before(std::uint32_t corner) const {
        const auto p = edges_.polygon(corner);
        const auto first = static_cast<std::uint32_t>(surface_.polygons.first_corner(p)),
                   size = static_cast<std::uint32_t>(surface_.polygons[p].size());
        return corner == first ? first + size - 1 : corner - 1;
    }
    std::uint32_t corner_of(std::uint32_t polygon, std::uint32_t node) const {
        auto corner = static_cast<std::uint32_t>(surface_.polygons.first_corner(polygon));
        while (surface_.polygons.corners[corner] != node) ++corner;
        return corner;
    }
    bool is_same_edge(std::uint32_t first, std::uint32_t second) const {
        const std::uint32_t a = edges_.start_node(first), b = edges_.end_node(first);
        const std::uint32_t c = edges_.start_node(second), d = edges_.end_node(second);
        return (a == c && b == d) || (a == d && b == c);
    }
};

/// Vertices away from lines where the polygons make more than one ring; ascending.
std::vector<std::uint32_t> pinched_vertices(const ModelScope& scope, std::uint32_t s, std::span<const std::uint8_t> on_any_line) {
    const auto& surface = scope.brep().surfaces[s];
    const CornersAt at = corners_at(surface, scope.model().faces[s], set_aside(scope, surface, on_any_line));
    const topology::PolygonEdges edges(surface.polygons);
    const RingWalk walk(surface, edges);
    std::vector<std::uint32_t> pinched, used;
    for (std::uint32_t n = 0; n < at.count.size(); ++n) {
        if (at.count[n] == 0) continue;
        if (scope.has_twin_nodes(s)) used.push_back(surface.nodes[n].value);
        if (walk.size(at.any[n], at.count[n]) != at.count[n]) pinched.push_back(surface.nodes[n].value);
    }
    std::ranges::sort(used);  // polygons of two nodes at one vertex have no edge in common
    for (std::size_t i = 1; i < used.size(); ++i) {
        if (used[i] == used[i - 1]) pinched.push_back(used[i]);
    }
    std::ranges::sort(pinched);
    const auto repeats = std::ranges::unique(pinched);
    pinched.erase(repeats.begin(), repeats.end());
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
    const std::vector<std::uint8_t> on_any_line = vertices_on_lines(scope.brep());
    parallel_for_each_index(pinched.size(), [&](std::size_t s) {
        if (!scope.stopped()) pinched[s] = pinched_vertices(scope, static_cast<std::uint32_t>(s), on_any_line);
    });
    if (scope.model().stated) report_stated_manifold(scope, pinched, findings);
    else report_loose_manifold(scope, pinched, findings);
}

}  // namespace geomend::validators
