// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>

#include "validators/cell_findings.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

using VertexOnSurface = std::pair<std::uint32_t, std::uint32_t>;  // vertex, surface

/// Which surfaces use which vertices, for vertices that several surfaces use; ascending.
std::vector<VertexOnSurface> shared_uses(const BrepData& brep) {
    std::vector<std::uint32_t> first(brep.vertices.size(), no_index);
    std::vector<std::uint8_t> several(brep.vertices.size(), 0);
    const auto each_use = [&](const auto& visit) {
        for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
            for (const std::uint32_t node : brep.surfaces[s].polygons.corners) visit(brep.surfaces[s].nodes[node].value, s);
        }
    };
    each_use([&](std::uint32_t v, std::uint32_t s) {
        if (first[v] != no_index && first[v] != s) several[v] = 1;
        first[v] = s;
    });
    std::vector<VertexOnSurface> uses;
    each_use([&](std::uint32_t v, std::uint32_t s) {
        if (several[v] != 0) uses.emplace_back(v, s);
    });
    std::ranges::sort(uses);
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    return uses;
}

/// Which vertices lie on which surfaces' own lines; ascending.
std::vector<VertexOnSurface> line_uses(const BrepData& brep) {
    std::vector<VertexOnSurface> uses;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const auto& use : brep.surfaces[s].lines) {
            for (const VertexId v : brep.lines[use.line.value].vertices) uses.emplace_back(v.value, s);
        }
    }
    std::ranges::sort(uses);
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    return uses;
}

}  // namespace

void check_shared_points(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const auto uses = shared_uses(brep), on_lines = line_uses(brep);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> touching;
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t j = i + 1;
        while (j < uses.size() && uses[j].first == uses[i].first) ++j;
        for (std::size_t a = i; a < j; ++a) {
            if (std::ranges::binary_search(on_lines, uses[a])) continue;
            for (std::size_t b = i; b < j; ++b) {
                if (b != a) touching[std::minmax(uses[a].second, uses[b].second)].push_back(uses[a].first);
            }
        }
        i = j;
    }
    for (auto& [pair, vertices] : touching) {
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        Finding finding = finding_of("B22", quoted(brep.surfaces[pair.first].name) + " and " + quoted(brep.surfaces[pair.second].name) +
                                                " touch in " + counted(vertices.size(), "point", "points") + " where they share no line");
        finding.entities = {surface_ref(scope, pair.first), surface_ref(scope, pair.second)};
        finding.element_kind = "point";
        finding.count = vertices.size();
        for (const std::uint32_t v : vertices) {
            if (finding.points.size() < listed_elements) finding.points.push_back(brep.vertices[v]);
        }
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
