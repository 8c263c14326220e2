// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/cell_volume.h"
#include "topology/face_edges.h"
#include "validators/cell_findings.h"
#include "validators/each_surface.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Squared cosine of the smallest angle; 0 for triangles with two corners at one place, which B01 tells.
double sharpest(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    const double l[3] = {dot(ab, ab), dot(ac, ac), dot(bc, bc)};
    const double shortest = std::min({l[0], l[1], l[2]});
    const double longest = std::max({l[0], l[1], l[2]}), middle = l[0] + l[1] + l[2] - shortest - longest;
    if (shortest == 0) return 0;
    const double cosine2 = longest + middle - shortest;  // twice the product of the two sides and the cosine
    return cosine2 * cosine2 / (4 * longest * middle);
}

}  // namespace

void check_triangle_angles(const ModelScope& scope, std::vector<Finding>& findings) {
    const double limit = std::pow(std::cos(smallest_angle / degrees), 2);
    judge_polygons(scope, findings, "Q01", "has an angle below 1 degree", "have an angle below 1 degree",
                   [&](const BrepData::Surface& surface, std::uint32_t p) {
                       const auto polygon = surface.polygons[p];
                       return polygon.size() == 3 &&
                              sharpest(scope.vertex_of_node(surface, polygon[0]), scope.vertex_of_node(surface, polygon[1]),
                                       scope.vertex_of_node(surface, polygon[2])) > limit;
                   });
}

void check_short_edges(const ModelScope& scope, std::vector<Finding>& findings) {
    const auto words = [&](std::uint32_t s) {
        const std::string than = "an edge shorter than " + rounded(scope.lengths(s).near);
        return PolygonWords{"has " + than, "have " + than};
    };
    judge_polygons(scope, findings, "Q02", words, [&](std::uint32_t s, std::uint32_t p) {
        const auto& surface = scope.brep().surfaces[s];
        const auto polygon = surface.polygons[p];
        const double limit = scope.lengths(s).near * scope.lengths(s).near;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec3 d =
                minus(scope.vertex_of_node(surface, polygon[i]), scope.vertex_of_node(surface, polygon[(i + 1) % polygon.size()]));
            if (dot(d, d) < limit && dot(d, d) > 0) return true;
        }
        return false;
    });
}

void check_folds(const ModelScope& scope, std::vector<Finding>& findings) {
    const double limit = std::cos(smallest_fold_angle / degrees);
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        if (!surface.polygons.all_triangles()) return std::nullopt;
        // By the directions in which the two triangles leave their edge, whatever sense they are wound in.
        const auto& corners = surface.polygons.corners;
        const auto leaving = [&](std::uint32_t p, std::uint32_t from, std::uint32_t to) {
            std::size_t tip = 3 * std::size_t{p};
            while (corners[tip] == from || corners[tip] == to) ++tip;
            const Vec3& base = scope.vertex_of_node(surface, from);
            return across(minus(scope.vertex_of_node(surface, corners[tip]), base), minus(scope.vertex_of_node(surface, to), base));
        };
        std::vector<std::uint32_t> folded;
        double worst = 0;
        for (std::uint32_t c = 0; c < surface.neighbours.size(); ++c) {
            const std::uint32_t p = c / 3, q = surface.neighbours[c];
            if (q == no_index || q < p) continue;
            const std::uint32_t from = corners[c], to = corners[c % 3 == 2 ? c - 2 : c + 1];
            const Vec3 a = leaving(p, from, to), b = leaving(q, from, to);
            if (dot(a, b) <= 0) continue;
            const double cosine = dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
            if (!(cosine > limit)) continue;
            worst = std::max(worst, cosine);
            folded.push_back(p);
            folded.push_back(q);
        }
        if (folded.empty()) return std::nullopt;
        std::ranges::sort(folded);
        folded.erase(std::unique(folded.begin(), folded.end()), folded.end());
        const double angle = degrees * std::acos(std::min(worst, 1.0));
        Finding finding = polygons_finding(scope, "Q03", s,
                                           counted(folded.size(), "triangle", "triangles") + " of " + quoted(surface.name) +
                                               " are folded back onto their neighbours, at " + rounded(angle) + " degrees",
                                           folded);
        finding.measures = {{"angle", angle}};
        return finding;
    });
}

void check_contact_angles(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const auto& graph = scope.model().graph;
    const double limit = std::cos(smallest_contact_angle / degrees);
    std::vector<topology::PolygonEdges> edges;
    for (const auto& surface : brep.surfaces) edges.emplace_back(surface.polygons);
    std::vector<double> worst(brep.lines.size(), -1);
    parallel_for_each_index(brep.lines.size(), [&](std::size_t l) {
        std::vector<Vec3> directions;
        for (std::uint32_t k = graph.line_first_edge[l]; k < graph.line_first_edge[l + 1]; ++k) {
            directions.clear();
            const auto uses = graph.edge_uses(graph.edges[graph.line_edges[k]]);
            const Vec3& a = brep.vertices[uses[0].low];
            const Vec3& b = brep.vertices[uses[0].high];
            for (const auto& use : uses) {
                if (use.surface == no_index) continue;
                const auto& surface = brep.surfaces[use.surface];
                const VertexId tip = topology::far_vertex(brep, surface, edges[use.surface].polygon(use.corner), a, b);
                const Vec3 leaving = across(minus(brep.vertices[tip.value], a), minus(b, a));
                const double length = std::sqrt(dot(leaving, leaving));
                if (length > 0) directions.push_back(times(1 / length, leaving));
            }
            for (std::size_t i = 0; i < directions.size(); ++i) {
                for (std::size_t j = i + 1; j < directions.size(); ++j) worst[l] = std::max(worst[l], dot(directions[i], directions[j]));
            }
        }
    });
    for (std::uint32_t l = 0; l < worst.size(); ++l) {
        if (worst[l] <= limit) continue;
        const double angle = degrees * std::acos(std::min(worst[l], 1.0));
        Finding finding = finding_of("Q04", "surfaces meet at " + rounded(angle) + " degrees along a line");
        finding.entities.push_back(line_ref(scope, l));
        for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
            const bool there = std::ranges::any_of(brep.surfaces[s].lines, [&](const auto& use) { return use.line.value == l; });
            if (there) finding.entities.push_back(surface_ref(scope, s));
        }
        finding.count = 1;
        finding.measures = {{"angle", angle}};
        mark_line(scope, l, finding);
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
