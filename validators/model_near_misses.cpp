// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/near_misses.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "geometry/vectors.h"
#include "validators/cell_findings.h"
#include "validators/model_checks.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

/// The free borders of surfaces that are judged by the same lengths: what lies in other clusters is farther off than any search goes.
struct Borders {
    Lengths lengths;
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< vertices in the model
    std::vector<std::uint32_t> surfaces;              ///< the surface that each belongs to
};

/// The free borders of a model by the lengths that they are judged by.
std::vector<Borders> borders_by_lengths(const ModelScope& scope) {
    const auto surfaces = static_cast<std::uint32_t>(scope.brep().surfaces.size());
    std::map<std::array<double, 3>, std::uint32_t> known;
    std::vector<Borders> all;
    std::vector<std::uint32_t> place(surfaces);
    for (std::uint32_t s = 0; s < surfaces; ++s) {
        const Lengths& l = scope.lengths(s);
        const auto [at, is_new] = known.try_emplace({l.tolerance, l.near, l.flatness}, static_cast<std::uint32_t>(all.size()));
        if (is_new) all.emplace_back().lengths = l;
        place[s] = at->second;
    }
    const auto& graph = scope.model().graph;
    for (const auto& edge : graph.edges) {
        if (edge.line == no_index || scope.free_lines()[edge.line] == 0) continue;
        for (const auto& use : graph.edge_uses(edge)) {
            if (use.surface == no_index) continue;
            all[place[use.surface]].edges.push_back({use.low, use.high});
            all[place[use.surface]].surfaces.push_back(use.surface);
        }
    }
    return all;
}

/// Pairs of surfaces of which findings say already how they meet.
class Reported {
public:
    explicit Reported(std::span<const Finding> findings) {
        for (const Finding& f : findings) add(f);
    }
    void add(const Finding& f) {
        static constexpr std::array codes = {"B08", "B10", "B11", "B20", "B22", "B23"};
        if (f.entities.size() != 2 || std::ranges::find(codes, f.code) == codes.end()) return;
        pairs_.insert(std::minmax(f.entities[0].id, f.entities[1].id));
    }
    bool has(std::uint32_t a, std::uint32_t b) const { return pairs_.contains(std::minmax(std::int64_t{a}, std::int64_t{b})); }

private:
    std::set<std::pair<std::int64_t, std::int64_t>> pairs_;
};

std::array<Vec3, 3> triangle_at(const ModelScope& scope, std::uint32_t triangle) {
    const auto& t = scope.triangles()[triangle];
    const auto& v = scope.brep().vertices;
    return {v[t[0]], v[t[1]], v[t[2]]};
}

/// Whether a good part of an edge, not only a point of it, is within the tolerance of a surface.
bool runs_along(const ModelScope& scope, const std::array<Vec3, 2>& edge, std::uint32_t surface) {
    constexpr double clearly = 100;  // tolerances: else it only leans
    const double tolerance = scope.lengths(surface).tolerance;
    Vec3 low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(edge[0][k], edge[1][k]);
        high[k] = std::max(edge[0][k], edge[1][k]);
    }
    const TriangleTree& tree = scope.tree();
    bool found = false;
    tree.visit_triangles(tree.box(low, high, tolerance), [&](std::size_t i) {
        const std::uint32_t t = tree.number(i);
        if (!found && scope.surface_of(t) == surface) found = length_on(edge, triangle_at(scope, t), tolerance) > clearly * tolerance;
    });
    return found;
}

/// A surface that ends on another one within the tolerance, and how it does that.
Finding touch_finding(const ModelScope& scope, std::uint32_t border, std::uint32_t other, std::span<const NearMiss> misses,
                      const Borders& some) {
    const double tolerance = some.lengths.tolerance;
    bool one_point = true, lies_on = false;
    for (const NearMiss& miss : misses.first(std::min(misses.size(), listed_elements))) {
        const Vec3 d = minus(miss.on_edge, misses[0].on_edge);
        one_point = one_point && dot(d, d) <= 4 * tolerance * tolerance;
        const auto& edge = some.edges[miss.border_edge];
        const auto& v = scope.brep().vertices;
        one_point = one_point && !runs_along(scope, {v[edge[0]], v[edge[1]]}, other);
        for (std::uint32_t t = scope.first_triangle(border); t < scope.first_triangle(border + 1) && !lies_on; ++t) {
            const auto has = [&](std::uint32_t end) { return std::ranges::find(scope.triangles()[t], end) != scope.triangles()[t].end(); };
            lies_on =
                has(edge[0]) && has(edge[1]) && lie_on_each_other(triangle_at(scope, t), triangle_at(scope, miss.triangle), tolerance);
        }
    }
    const std::string a = quoted(scope.brep().surfaces[border].name), b = quoted(scope.brep().surfaces[other].name);
    Finding touch = lies_on     ? finding_of("B20", a + " and " + b + " overlap, within the tolerance")
                    : one_point ? finding_of("B22", a + " and " + b + " touch at a point that they do not share, within the tolerance")
                                : finding_of("B11", a + " ends on " + b + ", within the tolerance, without sharing vertices");
    touch.entities = {surface_ref(scope, border), surface_ref(scope, other)};
    touch.count = misses.size();
    touch.element_kind = "edge";
    for (const NearMiss& miss : misses.first(std::min(misses.size(), listed_elements))) touch.points.push_back(miss.on_edge);
    return touch;
}

void report_borders(const ModelScope& scope, const Borders& some, const SurfaceDistance& soup, Reported& reported,
                    std::vector<Finding>& findings) {
    const double tolerance = some.lengths.tolerance;
    // In a basin that is a hundred times as wide as it is thick borders leave surfaces more slowly than in a cube.
    const double slow = 0.05 * some.lengths.flatness;
    const auto misses = near_misses(soup, some.edges, some.surfaces, some.lengths.near, scope.monitor(), tolerance, slow);
    struct Pair {
        double smallest = 0, largest = 0;
        Finding finding;
        std::vector<NearMiss> touches;  // within the tolerance
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Pair> pairs;
    for (const NearMiss& miss : misses) {
        const std::uint32_t border = some.surfaces[miss.border_edge], other = scope.surface_of(miss.triangle);
        Pair& pair = pairs[{border, other}];
        if (miss.distance <= tolerance) {
            pair.touches.push_back(miss);
            continue;
        }
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
        if (!pair.touches.empty() && !reported.has(border, other)) {
            findings.push_back(touch_finding(scope, border, other, pair.touches, some));
            reported.add(findings.back());
        }
        if (pair.finding.count == 0) continue;
        const std::string where = border == other ? "itself" : quoted(scope.brep().surfaces[other].name);
        const std::string smallest = rounded(pair.smallest), largest = rounded(pair.largest);
        Finding finding = finding_of("B23", "the border of " + quoted(scope.brep().surfaces[border].name) + " nearly meets " + where +
                                                ": " + counted(pair.finding.count, "edge is ", "edges are ") + smallest +
                                                (largest != smallest ? " to " + largest : std::string()) + " away");
        finding.entities.push_back(surface_ref(scope, border));
        if (border != other) finding.entities.push_back(surface_ref(scope, other));
        finding.count = pair.finding.count;
        finding.element_kind = "edge";
        finding.points = std::move(pair.finding.points);
        finding.polylines = std::move(pair.finding.polylines);
        finding.measures = {{"gap", pair.smallest}, {"largest_gap", pair.largest}};
        reported.add(finding);
        findings.push_back(std::move(finding));
    }
}

/// B24 where the search was cut short, one for each length.
void report_cut_short(const ModelScope& scope, std::span<const std::uint32_t> surfaces, std::vector<Finding>& findings) {
    std::set<double> lengths;
    for (const std::uint32_t s : surfaces) lengths.insert(scope.lengths(s).near);
    for (const double near : lengths) {
        Finding finding = finding_of("B24", "the search length, " + rounded(near) +
                                                ", is many times the length of edges in places: not all that is near was examined there"
                                                "; check again with a smaller --near");
        finding.count = 1;
        findings.push_back(std::move(finding));
    }
}

void report_surfaces(const ModelScope& scope, const SurfaceDistance& soup, const Reported& reported, std::vector<Finding>& findings) {
    std::vector<double> near;
    for (std::uint32_t s = 0; s < scope.brep().surfaces.size(); ++s) near.push_back(scope.lengths(s).near);
    const ClosePairs found = closest_pairs(soup, near, scope.monitor());
    for (const ClosePair& close : found.pairs) {
        if (reported.has(close.group_a, close.group_b)) continue;
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
    report_cut_short(scope, found.cut_short, findings);
}

}  // namespace

void check_near_misses(const ModelScope& scope, std::vector<Finding>& findings) {
    // Where very many surfaces lie across each other everything is near everything, and that has been told.
    if (std::ranges::any_of(findings, [](const Finding& f) { return f.code == "B08" && f.entities.empty(); })) return;
    if (scope.triangles().empty() || scope.stopped()) return;
    const SurfaceDistance soup(scope.tree(), scope.surfaces_of_triangles());
    Reported reported(findings);
    for (const Borders& some : borders_by_lengths(scope)) {
        if (some.lengths.near > 0 && !scope.stopped()) report_borders(scope, some, soup, reported, findings);
    }
    if (!scope.stopped()) report_surfaces(scope, soup, reported, findings);
}

}  // namespace geomend::validators
