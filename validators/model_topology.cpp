// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "base/disjoint_sets.h"
#include "geometry/vectors.h"
#include "topology/face_edges.h"
#include "topology/pieces.h"
#include "validators/cell_findings.h"
#include "validators/each_surface.h"
#include "validators/free_borders.h"
#include "validators/loose_seams.h"
#include "validators/model_checks.h"
#include "validators/region_volumes.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

/// The largest distance of a vertex of some lines from the mean of them all.
double radius(const BrepData& brep, std::span<const std::uint32_t> lines) {
    Vec3 sum{};
    std::size_t count = 0;
    for (const std::uint32_t l : lines) {
        for (const VertexId v : brep.lines[l].vertices) sum = plus(sum, brep.vertices[v.value]);
        count += brep.lines[l].vertices.size();
    }
    const Vec3 middle = times(1.0 / static_cast<double>(count), sum);
    double square = 0;
    for (const std::uint32_t l : lines) {
        for (const VertexId v : brep.lines[l].vertices) {
            const Vec3 d = minus(brep.vertices[v.value], middle);
            square = std::max(square, dot(d, d));
        }
    }
    return std::sqrt(square);
}

std::uint64_t edge_key(VertexId a, VertexId b) { return std::uint64_t{std::min(a.value, b.value)} << 32 | std::max(a.value, b.value); }

/// Edges of lines that more than one surface uses; ascending.
struct SharedEdges {
    std::vector<std::uint64_t> all;
    std::vector<std::uint64_t> through;  ///< those with four uses or more: none of the surfaces only ends there
};

SharedEdges edges_of_several_surfaces(const ModelScope& scope) {
    const topology::LineGraph& graph = scope.model().graph;
    SharedEdges shared;
    for (const auto& edge : graph.edges) {
        const auto uses = graph.edge_uses(edge);
        std::uint32_t first = no_index, count = 0;
        bool several = false;
        for (const auto& use : uses) {
            if (use.surface == no_index) continue;  // a line that the file states
            if (first == no_index) first = use.surface;
            several |= use.surface != first;
            ++count;
        }
        if (!several) continue;
        shared.all.push_back(edge_key(VertexId(uses[0].low), VertexId(uses[0].high)));
        if (count > 3) shared.through.push_back(shared.all.back());
    }
    std::ranges::sort(shared.all);
    std::ranges::sort(shared.through);
    return shared;
}

/// The numbers of polygons of the pieces, each by its first polygon.
std::map<std::uint32_t, std::uint64_t> sizes_of(const std::vector<std::uint32_t>& pieces) {
    std::map<std::uint32_t, std::uint64_t> polygons_of;
    for (const std::uint32_t piece : pieces) {
        if (piece != no_index) ++polygons_of[piece];
    }
    return polygons_of;
}

/// Per line whether it is one that the file states inside of a surface, with the same nodes on both of its sides: nothing is open there.
std::vector<std::uint8_t> embedded_lines(const ModelScope& scope) {
    const topology::LineGraph& graph = scope.model().graph;
    std::vector<std::uint8_t> embedded(scope.brep().lines.size(), 0);
    for (const auto& edge : graph.edges) {
        const bool is_stated = std::ranges::any_of(graph.edge_uses(edge), [](const auto& use) { return use.surface == no_index; });
        if (is_stated) embedded[edge.line] = scope.model().joined_lines[edge.line];
    }
    return embedded;
}

/// Edges of such lines; ascending.
std::vector<std::uint64_t> embedded_edges(const ModelScope& scope) {
    const auto embedded = embedded_lines(scope);
    const topology::LineGraph& graph = scope.model().graph;
    std::vector<std::uint64_t> edges;
    for (const auto& edge : graph.edges) {
        if (embedded[edge.line] == 0) continue;
        const auto& use = graph.uses[edge.first_use];
        edges.push_back(edge_key(VertexId(use.low), VertexId(use.high)));
    }
    std::ranges::sort(edges);
    return edges;
}

/// Per polygon the first one of the piece that hangs together by edges, but for those in `cuts` (ascending), and
/// across lines that are only embedded; degenerate and repeated polygons: no_index. Empty where all is one piece, even apart at all lines.
std::vector<std::uint32_t> pieces_by_edges(const BrepData::Surface& surface, const topology::FaceEdges& face,
                                           const std::vector<std::uint64_t>& cuts, const std::vector<std::uint64_t>& embedded) {
    std::vector<std::uint32_t> piece_of;
    if (topology::number_pieces(surface, face, piece_of) < 2) return {};
    DisjointSets pieces(surface.polygons.size());
    const topology::PolygonEdges edges(surface.polygons);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> at_border;  // by nodes
    std::map<std::uint64_t, std::uint32_t> at_embedded;                          // by vertices
    std::vector<std::uint8_t> aside(surface.polygons.size(), 0);
    for (const std::uint32_t p : face.degenerate) aside[p] = 1;
    for (const std::uint32_t p : face.duplicate) aside[p] = 1;
    for (std::uint32_t c = 0; c < surface.neighbours.size(); ++c) {
        const std::uint32_t p = edges.polygon(c);
        if (aside[p] != 0) continue;
        if (surface.neighbours[c] != no_index) {
            pieces.join(p, surface.neighbours[c]);
            continue;
        }
        const std::uint32_t from = edges.start_node(c), to = edges.end_node(c);
        if (!cuts.empty() && std::ranges::binary_search(cuts, edge_key(surface.nodes[from], surface.nodes[to]))) continue;
        const std::uint64_t key = edge_key(surface.nodes[from], surface.nodes[to]);
        if (std::ranges::binary_search(embedded, key)) pieces.join(p, at_embedded.emplace(key, p).first->second);
        pieces.join(p, at_border.emplace(std::minmax(from, to), p).first->second);
    }
    std::vector<std::uint32_t> roots(surface.polygons.size(), no_index);
    for (std::uint32_t p = 0; p < roots.size(); ++p) {
        if (aside[p] == 0) roots[p] = pieces.root(p);
    }
    return roots;
}

/// Whether a surface is a set of faces of cells in one mesh, which fill the regions beside it: these do not depend on it.
bool is_set_of_cell_faces(const BrepData& brep, const BrepData::Surface& surface) {
    return std::ranges::any_of(surface.regions, [&](RegionId r) {
        if (!r.valid()) return false;
        const auto& region = brep.regions[r.value];
        return !region.cell_types.empty() && region.source_object == surface.source_object;
    });
}

}  // namespace

void check_pieces(const ModelScope& scope, std::vector<Finding>& findings) {
    if (!scope.model().stated) return;
    // Regions that are found by walking along sides are not told apart by a surface whose sides go on across another one; one that
    // only ends there parts them where other regions lie on the two parts of the surface.
    const auto embedded = embedded_edges(scope);
    const SharedEdges cuts = scope.model().regions_stated ? SharedEdges{} : edges_of_several_surfaces(scope);
    const auto is_between_several = cuts.all.empty() || surfaces_are_whole(scope)
                                        ? std::vector<std::uint8_t>(scope.brep().surfaces.size(), 0)
                                        : surfaces_between_several(scope);
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        if (is_set_of_cell_faces(scope.brep(), surface)) return std::nullopt;
        auto polygons_of = sizes_of(pieces_by_edges(surface, scope.model().faces[s], {}, embedded));
        const bool is_cut = polygons_of.size() < 2;
        const auto& own_cuts = is_between_several[s] != 0 ? cuts.all : cuts.through;
        if (is_cut && !own_cuts.empty()) polygons_of = sizes_of(pieces_by_edges(surface, scope.model().faces[s], own_cuts, embedded));
        if (polygons_of.size() < 2) return std::nullopt;
        std::uint64_t largest = 0, all = 0;
        for (const auto& [piece, count] : polygons_of) {
            largest = std::max(largest, count);
            all += count;
        }
        Finding finding =
            finding_of("B04", quoted(surface.name) + " falls into " + std::to_string(polygons_of.size()) +
                                  (is_cut ? " parts where other surfaces cut through it; " : " parts that are not connected; ") +
                                  std::to_string(all - largest) + " of its " + std::to_string(all) + " triangles are not in the largest");
        finding.entities.push_back(surface_ref(scope, s));
        finding.count = polygons_of.size();
        finding.element_kind = "part";
        for (const auto& [piece, count] : polygons_of) {
            if (finding.points.size() < listed_elements)
                finding.points.push_back(scope.vertex_of_node(surface, surface.polygons[piece][0]));
        }
        return finding;
    });
}

void check_seams(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint32_t> uses(brep.lines.size(), 0), owner(brep.lines.size(), no_index);
    std::vector<std::uint8_t> shared(brep.lines.size(), 0);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const auto& use : brep.surfaces[s].lines) {
            std::uint32_t& first = owner[use.line.value];
            if (first != no_index && first != s) shared[use.line.value] = 1;
            first = s;
            ++uses[use.line.value];
        }
    }
    std::map<std::uint32_t, Finding> of_surface;
    const auto embedded = embedded_lines(scope), between_pieces = seams_between_pieces(scope);
    const auto first = first_of_part(scope);
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        const bool inside_one = shared[l] == 0 && uses[l] >= 2 && embedded[l] == 0;
        if (!inside_one && between_pieces[l] == 0) continue;
        Finding& finding = of_surface[first[owner[l]]];
        ++finding.count;
        finding.entities.push_back(line_ref(scope, l));
        if (finding.index.size() < listed_elements) finding.index.push_back(l);
        mark_line(scope, l, finding);
    }
    for (auto& [s, lines] : of_surface) {
        Finding finding = finding_of("B07", quoted(brep.surfaces[s].name) + " is open along " + counted(lines.count, "seam", "seams") +
                                                ": borders of it coincide there, but their points are not joined");
        if (!scope.model().stated) use_other_severity(finding);
        finding.count = lines.count;
        finding.element_kind = "line";
        finding.index = std::move(lines.index);
        finding.polylines = std::move(lines.polylines);
        finding.entities.push_back(surface_ref(scope, s));
        lines.entities.resize(std::min(lines.entities.size(), listed_elements));
        finding.entities.insert(finding.entities.end(), lines.entities.begin(), lines.entities.end());
        findings.push_back(std::move(finding));
    }
}

namespace {

std::array<Vec3, 3> triangle_of(const ModelScope& scope, const topology::EdgeUse& use) {
    const auto& surface = scope.brep().surfaces[use.surface];
    const auto polygon = surface.polygons[use.corner / 3];
    const auto at = [&](std::size_t k) { return scope.brep().vertices[surface.nodes[polygon[k]].value]; };
    return {at(0), at(1), at(2)};
}

/// B20 for surfaces that leave a line together and lie on each other there: by exact predicates they may cross, touch or lie beside
/// each other, as coordinates are rounded.
void report_overlaps_at_lines(const ModelScope& scope, std::span<const LineId> lines, std::vector<Finding>& findings) {
    std::map<std::pair<std::int64_t, std::int64_t>, Finding> overlaps;
    const auto& graph = scope.model().graph;
    const auto take = [&](const topology::EdgeUse& a, const topology::EdgeUse& b) {
        const auto& surfaces = scope.brep().surfaces;
        if (a.surface == b.surface || !surfaces[a.surface].polygons.all_triangles() || !surfaces[b.surface].polygons.all_triangles())
            return;
        const double tolerance = std::max(scope.lengths(a.surface).tolerance, scope.lengths(b.surface).tolerance);
        const auto first = triangle_of(scope, a), second = triangle_of(scope, b);
        if (!lie_on_each_other(first, second, tolerance)) return;
        const auto [low, high] = std::pair(std::min(a.surface, b.surface), std::max(a.surface, b.surface));
        Finding& finding = overlaps[{low, high}];
        ++finding.count;
        if (finding.points.size() < listed_elements) finding.points.push_back(times(1.0 / 3, plus(first[0], plus(first[1], first[2]))));
    };
    for (const LineId l : lines) {
        for (std::uint32_t e = graph.line_first_edge[l.value]; e < graph.line_first_edge[l.value + 1]; ++e) {
            const auto uses = graph.edge_uses(graph.edges[graph.line_edges[e]]);
            for (std::size_t i = 0; i < uses.size(); ++i) {
                for (std::size_t j = i + 1; j < uses.size(); ++j) {
                    if (uses[i].surface != no_index && uses[j].surface != no_index) take(uses[i], uses[j]);
                }
            }
        }
    }
    for (const Finding& f : findings) {
        if (f.code == "B20" && f.entities.size() == 2) overlaps.erase(std::minmax({f.entities[0].id, f.entities[1].id}));
    }
    for (auto& [pair, found] : overlaps) {
        const auto a = static_cast<std::uint32_t>(pair.first), b = static_cast<std::uint32_t>(pair.second);
        const auto& surfaces = scope.brep().surfaces;
        Finding finding =
            finding_of("B20", quoted(surfaces[a].name) + " and " + quoted(surfaces[b].name) + " overlap, within the tolerance");
        finding.entities = {surface_ref(scope, a), surface_ref(scope, b)};
        finding.count = found.count;
        finding.element_kind = "pair";
        finding.points = std::move(found.points);
        findings.push_back(std::move(finding));
    }
}

}  // namespace

void check_radial_order(const ModelScope& scope, std::vector<Finding>& findings) {
    const auto& lines = scope.model().found.uncertain_lines;
    if (lines.empty()) return;
    Finding finding =
        finding_of("B17", "polygons coincide at " + counted(lines.size(), "line", "lines") + ": which of them comes first around " +
                              (lines.size() == 1 ? "it" : "them") + " is not known, so regions that meet there were not told apart");
    finding.count = lines.size();
    finding.element_kind = "line";
    for (const LineId l : lines) {
        if (finding.entities.size() >= listed_elements) break;
        finding.entities.push_back(line_ref(scope, l.value));
        finding.index.push_back(l.value);
        mark_line(scope, l.value, finding);
    }
    findings.push_back(std::move(finding));
    report_overlaps_at_lines(scope, lines, findings);
}

void check_holes(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        // The widest loop of borders is the outline of the surface; others, where nothing else is, are holes.
        const auto& surface = brep.surfaces[s];
        std::vector<std::uint32_t> corners;
        for (const auto& use : surface.lines) {
            for (const CornerId c : brep.lines[use.line.value].corners) corners.push_back(c.value);
        }
        std::ranges::sort(corners);
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        DisjointSets joined(corners.size());
        const auto at = [&](CornerId c) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(corners, c.value) - corners.begin());
        };
        for (const auto& use : surface.lines) {
            const auto& ends = brep.lines[use.line.value].corners;
            joined.join(at(ends[0]), at(ends[1]));
        }
        struct Loop {
            bool free = true;
            std::vector<std::uint32_t> lines;
        };
        std::map<std::uint32_t, Loop> loops;
        for (const auto& use : surface.lines) {
            if (use.internal) continue;  // a cut, with the surface on both sides
            Loop& loop = loops[joined.root(at(brep.lines[use.line.value].corners[0]))];
            loop.free = loop.free && scope.free_lines()[use.line.value] != 0;
            loop.lines.push_back(use.line.value);
        }
        const Loop* outline = nullptr;  // the widest one
        double widest = -1;
        for (const auto& [first, loop] : loops) {
            const double width = radius(brep, loop.lines);
            if (width <= widest) continue;
            widest = width;
            outline = &loop;
        }
        std::vector<const Loop*> free;
        for (const auto& [first, loop] : loops) {
            if (loop.free && &loop != outline) free.push_back(&loop);
        }
        if (free.empty()) return std::nullopt;
        std::vector<std::uint32_t> lines;
        for (const Loop* loop : free) lines.insert(lines.end(), loop->lines.begin(), loop->lines.end());
        const auto borders = free_borders(scope, lines);
        Finding finding =
            finding_of("M07", quoted(surface.name) + " has " + counted(free.size(), "hole", "holes") + ": " + border_text(scope, borders));
        finding.entities.push_back(surface_ref(scope, s));
        finding.count = free.size();
        finding.element_kind = "hole";
        mark_borders(scope, borders, finding);
        return finding;
    });
}

}  // namespace geomend::validators
