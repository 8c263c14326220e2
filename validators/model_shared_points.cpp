// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <span>

#include "validators/cell_findings.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

using VertexOnSurface = std::pair<std::uint32_t, std::uint32_t>;  // vertex, surface

/// Visits the vertices of all polygons, with their surface: (vertex, surface).
template <class Visit>
void each_use(const BrepData& brep, const Visit& visit) {
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const std::uint32_t node : brep.surfaces[s].polygons.corners) visit(brep.surfaces[s].nodes[node].value, s);
    }
}

/// The vertices that several surfaces use: 1.
std::vector<std::uint8_t> shared_vertices(const BrepData& brep) {
    std::vector<std::uint32_t> last(brep.vertices.size(), no_index);
    std::vector<std::uint8_t> several(brep.vertices.size(), 0);
    each_use(brep, [&](std::uint32_t v, std::uint32_t s) {
        if (last[v] != no_index && last[v] != s) several[v] = 1;
        last[v] = s;
    });
    return several;
}

void sort_and_unite(std::vector<VertexOnSurface>& uses) {
    std::ranges::sort(uses);
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
}

/// Shared vertices with each surface that uses them, although none of its own lines does; ascending.
std::vector<VertexOnSurface> uses_off_lines(const BrepData& brep, std::span<const std::uint8_t> shared) {
    std::vector<std::uint32_t> on_line_of(brep.vertices.size(), no_index);
    std::vector<VertexOnSurface> uses;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const auto& use : brep.surfaces[s].lines) {
            for (const VertexId v : brep.lines[use.line.value].vertices) on_line_of[v.value] = s;
        }
        for (const std::uint32_t node : brep.surfaces[s].polygons.corners) {
            const std::uint32_t v = brep.surfaces[s].nodes[node].value;
            if (shared[v] != 0 && on_line_of[v] != s) uses.emplace_back(v, s);
        }
    }
    sort_and_unite(uses);
    return uses;
}

/// The vertices of these uses with all surfaces that use them; ascending.
std::vector<VertexOnSurface> all_uses(const BrepData& brep, std::span<const VertexOnSurface> some) {
    std::vector<std::uint8_t> is_wanted(brep.vertices.size(), 0);
    for (const auto& [vertex, surface] : some) is_wanted[vertex] = 1;
    std::vector<VertexOnSurface> uses;
    each_use(brep, [&](std::uint32_t v, std::uint32_t s) {
        if (is_wanted[v] != 0) uses.emplace_back(v, s);
    });
    sort_and_unite(uses);
    return uses;
}

}  // namespace

void check_shared_points(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const auto off_lines = uses_off_lines(brep, shared_vertices(brep));
    if (off_lines.empty()) return;
    const auto uses = all_uses(brep, off_lines);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> touching;
    auto at = uses.begin();
    for (const auto& [vertex, surface] : off_lines) {
        while (at->first != vertex) ++at;
        for (auto other = at; other != uses.end() && other->first == vertex; ++other) {
            if (other->second != surface) touching[std::minmax(surface, other->second)].push_back(vertex);
        }
    }
    for (auto& [pair, vertices] : touching) {
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        Finding finding = finding_of("B22", quoted(brep.surfaces[pair.first].name) + " and " + quoted(brep.surfaces[pair.second].name) +
                                                " touch in " + counted(vertices.size(), "point", "points") + " where they share no line");
        finding.entities = {surface_ref(scope, pair.first), surface_ref(scope, pair.second)};
        finding.element_kind = "point";
        finding.count = vertices.size();
        finding.measures = {{"shared_points", static_cast<double>(vertices.size())}};
        for (const std::uint32_t v : vertices) {
            if (finding.points.size() < listed_elements) finding.points.push_back(brep.vertices[v]);
        }
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
