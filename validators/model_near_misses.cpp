// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/near_misses.h"

#include <algorithm>
#include <array>
#include <map>

#include "validators/found_cells.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

/// Edges of free borders with the surface that each belongs to.
struct FreeBorders {
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> surfaces;
};

FreeBorders free_borders(const ModelScope& scope) {
    FreeBorders free;
    const auto& graph = scope.model().graph;
    for (const auto& edge : graph.edges) {
        if (edge.line == no_index || scope.free_lines()[edge.line] == 0) continue;
        for (const auto& use : graph.edge_uses(edge)) {
            if (use.surface == no_index) continue;
            free.edges.push_back({use.low, use.high});
            free.surfaces.push_back(use.surface);
        }
    }
    return free;
}

std::vector<std::uint32_t> surface_of_triangles(const ModelScope& scope) {
    std::vector<std::uint32_t> surfaces(scope.triangles().size());
    for (std::uint32_t s = 0; s < scope.brep().surfaces.size(); ++s) {
        for (std::uint32_t t = scope.first_triangle(s); t < scope.first_triangle(s + 1); ++t) surfaces[t] = s;
    }
    return surfaces;
}

/// Whether a finding about the two surfaces is there already that says how they meet.
bool is_told(const std::vector<Finding>& findings, std::uint32_t a, std::uint32_t b) {
    static constexpr std::array codes = {"B08", "B10", "B11", "B20", "B22", "B23"};
    return std::ranges::any_of(findings, [&](const Finding& f) {
        if (f.entities.size() != 2 || std::ranges::find(codes, f.code) == codes.end()) return false;
        const std::int64_t x = f.entities[0].id, y = f.entities[1].id;
        return (x == a && y == b) || (x == b && y == a);
    });
}

void tell_borders(const ModelScope& scope, std::span<const std::uint32_t> surfaces, std::vector<Finding>& findings) {
    const FreeBorders free = free_borders(scope);
    const auto misses = near_misses(scope.tree(), surfaces, free.edges, free.surfaces, scope.lengths().near, scope.monitor());
    struct Pair {
        double smallest = 0, largest = 0;
        Finding finding;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Pair> pairs;
    for (const NearMiss& miss : misses) {
        const std::uint32_t border = free.surfaces[miss.border_edge], other = surfaces[miss.triangle];
        Pair& pair = pairs[{border, other}];
        Finding& finding = pair.finding;
        pair.smallest = finding.count == 0 ? miss.distance : std::min(pair.smallest, miss.distance);
        pair.largest = std::max(pair.largest, miss.distance);
        ++finding.count;
        if (finding.polylines.size() >= listed_elements) continue;
        finding.polylines.push_back({miss.on_edge, miss.on_triangle});
        finding.points.push_back(miss.on_edge);
    }
    for (auto& [surface, pair] : pairs) {
        const auto& [border, other] = surface;
        if (pair.largest <= scope.lengths().tolerance) {
            if (is_told(findings, border, other)) continue;
            Finding touch =
                finding_of("B11", quoted(scope.brep().surfaces[border].name) + " ends on " + quoted(scope.brep().surfaces[other].name) +
                                      ", within the tolerance, without sharing vertices");
            touch.entities = {surface_ref(scope, border), surface_ref(scope, other)};
            touch.count = pair.finding.count;
            touch.element_kind = "edge";
            touch.points = std::move(pair.finding.points);
            findings.push_back(std::move(touch));
            continue;
        }
        const std::string where = border == other ? "itself" : quoted(scope.brep().surfaces[other].name);
        Finding finding = finding_of("B23", "the border of " + quoted(scope.brep().surfaces[border].name) + " nearly meets " + where +
                                                ": " + counted(pair.finding.count, "edge is ", "edges are ") + rounded(pair.smallest) +
                                                (pair.largest > pair.smallest ? " to " + rounded(pair.largest) : std::string()) + " away");
        finding.entities.push_back(surface_ref(scope, border));
        if (border != other) finding.entities.push_back(surface_ref(scope, other));
        finding.count = pair.finding.count;
        finding.element_kind = "edge";
        finding.points = std::move(pair.finding.points);
        finding.polylines = std::move(pair.finding.polylines);
        finding.measures = {{"gap", pair.smallest}, {"largest_gap", pair.largest}};
        findings.push_back(std::move(finding));
    }
}

void tell_surfaces(const ModelScope& scope, std::span<const std::uint32_t> surfaces, std::vector<Finding>& findings) {
    for (const ClosePair& close : closest_pairs(scope.tree(), surfaces, scope.lengths().near, scope.monitor())) {
        if (is_told(findings, close.group_a, close.group_b)) continue;
        const auto& a = scope.brep().surfaces[close.group_a];
        const auto& b = scope.brep().surfaces[close.group_b];
        Finding finding = finding_of("B24", quoted(a.name) + " and " + quoted(b.name) + " come within " + rounded(close.distance) +
                                                " of each other without meeting");
        finding.entities = {surface_ref(scope, close.group_a), surface_ref(scope, close.group_b)};
        finding.count = 1;
        finding.points = {close.on_a, close.on_b};
        finding.polylines = {{close.on_a, close.on_b}};
        finding.measures = {{"gap", close.distance}};
        findings.push_back(std::move(finding));
    }
}

}  // namespace

void check_near_misses(const ModelScope& scope, std::vector<Finding>& findings) {
    if (scope.lengths().near <= 0 || scope.triangles().empty()) return;
    // Where very many surfaces lie across each other everything is near everything, and that has been told.
    if (std::ranges::any_of(findings, [](const Finding& f) { return f.code == "B08" && f.entities.empty(); })) return;
    const auto surfaces = surface_of_triangles(scope);
    tell_borders(scope, surfaces, findings);
    tell_surfaces(scope, surfaces, findings);
}

}  // namespace geomend::validators
