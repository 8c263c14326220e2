// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/loose_seams.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/length.h"
#include "base/vectors.h"
#include "topology/face_edges.h"

namespace geomend::validators {

namespace {

/// The points of an element of an object, by their numbers in the file.
std::span<const std::uint32_t> points_of_element(const Object& object, std::size_t element) {
    if (const auto* surface = std::get_if<Surface>(&object)) return surface->polygons[element];
    if (const auto* mesh = std::get_if<CellMesh>(&object)) return mesh->cell_nodes(element);
    return {};
}

bool share_two_points(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    return std::ranges::count_if(a, [&](std::uint32_t point) { return std::ranges::find(b, point) != b.end(); }) >= 2;
}

double length_of(const BrepData& brep, std::uint32_t line) {
    const auto& vertices = brep.lines[line].vertices;
    double sum = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i)
        sum += length(minus(brep.vertices[vertices[i].value], brep.vertices[vertices[i - 1].value]));
    return sum;
}

/// Takes seams out that at both of their ends go on as contacts of the same two pieces with another surface, and are not longer than
/// these: it is that surface which lacks something between.
void leave_out_gaps_of_others(const BrepData& brep, std::vector<std::uint8_t>& seam) {
    if (std::ranges::none_of(seam, [](std::uint8_t is) { return is != 0; })) return;
    std::vector<std::set<std::uint32_t>> surfaces(brep.lines.size());
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const auto& use : brep.surfaces[s].lines) surfaces[use.line.value].insert(s);
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> lines_at;  // by corner
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        for (const CornerId corner : brep.lines[l].corners) lines_at[corner.value].push_back(l);
    }
    const auto source = [&](std::uint32_t s) { return std::pair(brep.surfaces[s].source_object, brep.surfaces[s].source_part); };
    const auto goes_on = [&](std::uint32_t l, CornerId corner, std::set<std::uint32_t>& contacts) {
        const auto own = source(*surfaces[l].begin());  // that of both pieces
        bool goes = false;
        for (const std::uint32_t next : lines_at[corner.value]) {
            const bool is_contact = next != l && std::ranges::includes(surfaces[next], surfaces[l]) &&
                                    std::ranges::any_of(surfaces[next], [&](std::uint32_t s) { return source(s) != own; });
            if (is_contact) contacts.insert(next), goes = true;
        }
        return goes;
    };
    for (std::uint32_t l = 0; l < seam.size(); ++l) {
        const auto& ends = brep.lines[l].corners;
        std::set<std::uint32_t> contacts;
        if (seam[l] == 0 || ends[0] == ends[1] || !goes_on(l, ends[0], contacts) || !goes_on(l, ends[1], contacts)) continue;
        double around = 0;
        for (const std::uint32_t contact : contacts) around += length_of(brep, contact);
        if (length_of(brep, l) <= around) seam[l] = 0;
    }
}

}  // namespace

std::vector<std::uint8_t> seams_between_pieces(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint8_t> seam(brep.lines.size(), 0), other(brep.lines.size(), 0);
    if (scope.model().stated) return seam;
    const topology::LineGraph& graph = scope.model().graph;
    std::vector<topology::PolygonEdges> edges_of;
    for (const auto& surface : brep.surfaces) edges_of.emplace_back(surface.polygons);
    std::vector<const topology::EdgeUse*> uses;
    for (const auto& edge : graph.edges) {
        uses.clear();
        for (const auto& use : graph.edge_uses(edge)) {
            if (use.surface != no_index) uses.push_back(&use);
        }
        const auto is_seam = [&] {
            if (uses.size() != 2 || uses[0]->surface == uses[1]->surface) return false;
            const auto &a = brep.surfaces[uses[0]->surface], &b = brep.surfaces[uses[1]->surface];
            if (a.source_object != b.source_object || a.source_part != b.source_part) return false;
            const Object& object = scope.dataset().objects[a.source_object];
            const auto points = [&](const topology::EdgeUse& use) {
                const std::int64_t number = scope.file_number(use.surface, edges_of[use.surface].polygon(use.corner));
                return points_of_element(object, static_cast<std::size_t>(number - 1));
            };
            return !share_two_points(points(*uses[0]), points(*uses[1]));
        };
        (is_seam() ? seam : other)[edge.line] = 1;
    }
    for (std::size_t l = 0; l < seam.size(); ++l) seam[l] = seam[l] != 0 && other[l] == 0 ? 1 : 0;
    leave_out_gaps_of_others(brep, seam);
    return seam;
}

std::vector<std::uint32_t> first_of_part(const ModelScope& scope) {
    const auto& surfaces = scope.brep().surfaces;
    std::vector<std::uint32_t> first(surfaces.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> of_part;
    for (std::uint32_t s = 0; s < first.size(); ++s) {
        first[s] = s;
        if (!scope.model().stated)
            first[s] = of_part.emplace(std::pair{surfaces[s].source_object, surfaces[s].source_part}, s).first->second;
    }
    return first;
}

}  // namespace geomend::validators
