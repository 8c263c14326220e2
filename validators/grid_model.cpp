// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/grid_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <span>

#include "geometry/cell_volume.h"
#include "geometry/intersections.h"
#include "validators/cell_findings.h"
#include "validators/model_checks.h"
#include "validators/polyline_join.h"
#include "validators/registry.h"

namespace geomend::validators {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;
using Side = grid::ModelSources::Side;

class GridModel {
public:
    GridModel(const GridScope& scope, const ModelScope& model, const grid::ModelSources& sources)
        : scope_(scope), model_(model), sources_(sources) {}

    const ModelScope& model() const { return model_; }
    const Side& side_of(std::uint32_t surface, std::uint32_t polygon) const {
        return sources_.sides[model_.brep().surfaces[surface].source_object][polygon];
    }
    const Side& side_of_triangle(std::uint32_t triangle) const {
        const std::uint32_t s = model_.surface_of(triangle);
        return side_of(s, triangle - model_.first_triangle(s));
    }

    /// Whether cells on both sides of two faces are in one column or in columns that share a pillar.
    bool are_neighbours(const Side& a, const Side& b) const {
        for (const std::uint32_t p : {a.first, a.second}) {
            for (const std::uint32_t q : {b.first, b.second}) {
                if (p != nobody && q != nobody && share_a_pillar(p, q)) return true;
            }
        }
        return false;
    }

    /// A finding about the model as one about the grid: it names the cells at its lines, else those at its surfaces.
    Finding about_grid(const Finding& of_model) const {
        FoundCells cells;
        for (const std::size_t cell : cells_of(of_model)) cells.add(cell, 0);
        Finding f = of_model;
        f.elements.clear();
        f.index.clear();
        list_cells(scope_.grid(), cells, f);
        f.count = std::max<std::uint64_t>(1, cells.count);
        f.entities = {{"corner-point-grid", scope_.grid().info.name}};
        for (const EntityRef& e : of_model.entities) {
            const EntityRef named{e.kind, e.name};
            const auto same = [&](const EntityRef& other) { return other.kind == named.kind && other.name == named.name; };
            if ((e.kind == "region" || e.kind == "surface") && std::ranges::none_of(f.entities, same)) f.entities.push_back(named);
        }
        return f;
    }

private:
    bool share_a_pillar(std::uint32_t p, std::uint32_t q) const {
        const auto a = scope_.grid().ijk(p), b = scope_.grid().ijk(q);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const auto apart =
                static_cast<std::uint32_t>(std::abs(static_cast<std::int64_t>(a[axis]) - static_cast<std::int64_t>(b[axis])));
            const bool closes = scope_.grid().cylindrical && axis == 1 && apart + 1 == scope_.grid().dims[1];
            if (apart > 1 && !closes) return false;
        }
        return true;
    }

    std::vector<std::size_t> cells_of(const Finding& f) const {
        std::vector<std::size_t> cells;
        const auto& graph = model_.model().graph;
        if (f.element_kind == "line") {
            for (const std::int64_t line : f.index) {
                const auto l = static_cast<std::size_t>(line);
                for (std::uint32_t e = graph.line_first_edge[l]; e < graph.line_first_edge[l + 1]; ++e) {
                    for (const topology::EdgeUse& use : graph.edge_uses(graph.edges[graph.line_edges[e]])) {
                        if (use.surface != no_index) cells.push_back(side_of(use.surface, use.corner / 3).first);
                    }
                }
            }
        } else {
            for (const EntityRef& e : f.entities) {
                if (e.kind != "surface" || e.id < 0) continue;
                const auto s = static_cast<std::uint32_t>(e.id);
                for (std::uint32_t p = 0; p < model_.brep().surfaces[s].polygons.size(); ++p) cells.push_back(side_of(s, p).first);
            }
        }
        std::ranges::sort(cells);
        cells.erase(std::ranges::unique(cells).begin(), cells.end());
        return cells;
    }

    const GridScope& scope_;
    const ModelScope& model_;
    const grid::ModelSources& sources_;
};

// ---- what runs into itself

Vec3 normal_of(const ModelScope& model, const std::array<std::uint32_t, 3>& t) {
    const auto& v = model.brep().vertices;
    return cross(minus(v[t[1]], v[t[0]]), minus(v[t[2]], v[t[0]]));
}

/// How far a triangle reaches through the plane of another one, on the side where it reaches less.
double depth_through(const ModelScope& model, const std::array<std::uint32_t, 3>& t, const std::array<std::uint32_t, 3>& plane) {
    const auto& v = model.brep().vertices;
    const Vec3 n = normal_of(model, plane);
    const double length = std::sqrt(dot(n, n));
    double above = 0, below = 0;
    for (const std::uint32_t corner : t) {
        const double distance = dot(minus(v[corner], v[plane[0]]), n) / length;
        above = std::max(above, distance);
        below = std::max(below, -distance);
    }
    return std::min(above, below);
}

struct Crossings {
    std::uint64_t pairs = 0;
    double deepest = 0;
    std::size_t first = 0, second = 0;  // cells of the deepest one
    std::vector<std::size_t> cells;
    std::vector<std::array<Vec3, 2>> segments;

    void add(const Side& a, const Side& b, double depth, const std::array<Vec3, 2>& segment) {
        if (pairs++ == 0 || depth > deepest) {
            deepest = depth;
            first = a.first;
            second = b.first;
        }
        cells.push_back(a.first);
        cells.push_back(b.first);
        if (segments.size() < 100000) segments.push_back(segment);
    }
};

Finding crossing_finding(const GridScope& scope, std::string_view code, std::string message, Crossings& found) {
    std::ranges::sort(found.cells);
    found.cells.erase(std::ranges::unique(found.cells).begin(), found.cells.end());
    FoundCells cells;
    for (const std::size_t cell : found.cells) cells.add(cell, 0);
    Finding f = cells_finding(scope, code, std::move(message), cells);
    f.polylines = join_segments(found.segments);
    if (f.polylines.size() > listed_elements) f.polylines.resize(listed_elements);
    f.measures = {{"pairs_of_triangles", static_cast<double>(found.pairs)}, {"depth", found.deepest}};
    return f;
}

/// Whether two outer faces that lie on each other look the same way: then both have cells behind them in one place, else
/// these only touch.
bool cover_each_other(const GridModel& grid, std::uint32_t a, std::uint32_t b) {
    const ModelScope& model = grid.model();
    const Side &sa = grid.side_of_triangle(a), &sb = grid.side_of_triangle(b);
    return sa.second == nobody && sb.second == nobody && !grid.are_neighbours(sa, sb) &&
           dot(normal_of(model, model.triangles()[a]), normal_of(model, model.triangles()[b])) > 0;
}

double length_of(const std::array<Vec3, 2>& segment) {
    const Vec3 d = minus(segment[1], segment[0]);
    return std::sqrt(dot(d, d));
}

std::array<Vec3, 2> longest_edge(const ModelScope& model, const std::array<std::uint32_t, 3>& t) {
    const auto& v = model.brep().vertices;
    std::array<std::array<Vec3, 2>, 3> edges{{{v[t[0]], v[t[1]]}, {v[t[1]], v[t[2]]}, {v[t[2]], v[t[0]]}}};
    return *std::ranges::max_element(edges, {}, length_of);
}

/// Triangles with the same three vertices: intersections() is about what triangles do not share.
void find_repeats(const GridScope& scope, const GridModel& grid, Crossings& apart) {
    const auto triangles = grid.model().triangles();
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> sorted(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        sorted[t] = {triangles[t], t};
        std::ranges::sort(sorted[t].first);
    }
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].first == sorted[i].first; ++j) {
            const std::uint32_t a = sorted[i].second, b = sorted[j].second;
            const auto edge = longest_edge(grid.model(), triangles[a]);
            if (length_of(edge) > scope.tolerance() && cover_each_other(grid, a, b))
                apart.add(grid.side_of_triangle(a), grid.side_of_triangle(b), 0, edge);
        }
    }
}

/// What crosses in columns that share no pillar, and between neighbours.
std::array<Crossings, 2> find_crossings(const GridScope& scope, const GridModel& grid) {
    const ModelScope& model = grid.model();
    Crossings apart, near;
    for (const TriangleMeetingPair& pair : intersections(model.tree(), scope.monitor())) {
        const Side &a = grid.side_of_triangle(pair.a), &b = grid.side_of_triangle(pair.b);
        if (pair.how.kind == Meeting::crossing) {
            const auto &one = model.triangles()[pair.a], &other = model.triangles()[pair.b];
            const double depth = std::min(depth_through(model, one, other), depth_through(model, other, one));
            if (depth > scope.tolerance()) (grid.are_neighbours(a, b) ? near : apart).add(a, b, depth, pair.how.segment);
        } else if (pair.how.kind == Meeting::overlap && length_of(pair.how.segment) > scope.tolerance() &&
                   cover_each_other(grid, pair.a, pair.b)) {
            apart.add(a, b, 0, pair.how.segment);
        }
    }
    find_repeats(scope, grid, apart);
    return {std::move(apart), std::move(near)};
}

Finding apart_finding(const GridScope& scope, Crossings& apart) {
    const std::string cells = cell_text(scope.grid(), apart.first) + " and " + cell_text(scope.grid(), apart.second);
    return crossing_finding(scope, "C27",
                            "cells of columns that share no pillar run into each other, such as " + cells + ": " +
                                counted(apart.pairs, "pair", "pairs") + " of their triangles cross or overlap, at most by " +
                                rounded(apart.deepest),
                            apart);
}

Finding near_finding(const GridScope& scope, Crossings& near, bool walked) {
    const std::string cells = cell_text(scope.grid(), near.first) + " and " + cell_text(scope.grid(), near.second);
    std::string message = counted(near.pairs, "pair", "pairs") +
                          " of triangles of the boundary representation cross between neighbours, at most by " + rounded(near.deepest) +
                          " at " + cells + ": faces are bent there";
    message += walked ? "; meshers that fill regions between triangles stop"
                      : "; meshers that fill regions between triangles stop, and walking along its surfaces does not find its regions";
    return crossing_finding(scope, "C28", std::move(message), near);
}

// ---- what closes

/// The sides of regions whose opposites are not among them; they ascend.
std::vector<std::uint32_t> outer_sides(std::vector<std::uint32_t> sides) {
    std::ranges::sort(sides);
    sides.erase(std::ranges::unique(sides).begin(), sides.end());
    std::vector<std::uint32_t> outer;
    for (const std::uint32_t side : sides) {
        if (!std::ranges::binary_search(sides, side ^ 1u)) outer.push_back(side);
    }
    return outer;
}

void add_sides(std::span<const BrepData::Side> sides, std::vector<std::uint32_t>& all) {
    for (const auto& side : sides) all.push_back(2 * side.surface.value + (side.front ? 1 : 0));
}

/// Whether a stated region is several regions as found together: blocks that faults part, or parts (C17 and C23 tell).
bool is_of_blocks(const ModelScope& model, std::size_t region) {
    const auto& found = model.model().found;
    std::vector<std::uint32_t> stated, together;
    add_sides(model.brep().regions[region].sides, stated);
    stated = outer_sides(std::move(stated));
    std::set<std::uint32_t> touched;
    for (const std::uint32_t side : stated) touched.insert(found.region_of_side[side]);
    for (const std::uint32_t r : touched) {
        if (r == no_index) return false;
        add_sides(found.regions[r], together);
    }
    return touched.size() > 1 && outer_sides(std::move(together)) == stated;
}

struct Closure {
    std::vector<Finding> open;    ///< B05: by counting sides along lines
    std::vector<Finding> walked;  ///< B06 B12 B13: by walking along surfaces, which needs their order around lines
};

Closure judge_closure(const GridModel& grid) {
    Closure closure;
    check_region_closed(grid.model(), closure.open);
    std::vector<Finding> all;
    for (const auto run : {check_model_closed, check_leaks, check_stated_regions}) run(grid.model(), all);
    for (Finding& f : all) {
        if (f.code == "B25") continue;  // faults lie inside
        const bool of_region = f.code == "B13" && !f.entities.empty() && f.entities[0].id >= 0;
        if (of_region && f.element_kind == "volume") continue;  // blocks that faults part within the sides of one region
        if (of_region && is_of_blocks(grid.model(), static_cast<std::size_t>(f.entities[0].id))) continue;
        closure.walked.push_back(std::move(f));
    }
    return closure;
}

void judge(const GridScope& scope, const GridModel& grid, const grid::ModelSources& sources, const CheckOptions& options,
           std::vector<Finding>& findings) {
    auto [apart, near] = find_crossings(scope, grid);
    const auto tell = [&](Finding f) {
        if (wanted(options, f.code)) findings.push_back(std::move(f));
    };
    if (apart.pairs > 0) tell(apart_finding(scope, apart));
    Closure closure;
    if (sources.unmatched_columns == 0) closure = judge_closure(grid);
    if (near.pairs > 0) tell(near_finding(scope, near, closure.walked.empty()));
    for (const Finding& f : closure.open) tell(grid.about_grid(f));
    const bool order_known = near.pairs == 0 && grid.model().model().found.uncertain_lines.empty();
    if (!order_known) return;
    for (const Finding& f : closure.walked) tell(grid.about_grid(f));
}

/// Whether all active cells have sound coordinates.
bool are_finite(const GridScope& scope) {
    for (std::size_t cell = 0; cell < scope.grid().cell_count(); ++cell) {
        if (scope.grid().is_active(cell) && !scope.judged(cell)) return false;
    }
    return true;
}

}  // namespace

Result<void> check_grid_model(const GridScope& scope, const grid::ModelRequest& request, const CheckOptions& options,
                              std::vector<Finding>& findings) {
    if (!are_finite(scope)) {
        findings.push_back(grid_finding(
            scope, "F162", "active cells have coordinates that are not finite (C02): the boundary representation was not judged"));
        return {};
    }
    grid::ModelSources sources;
    auto dataset = grid::boundary_model(scope.grid(), request, &sources);
    if (!dataset && dataset.why().kind == FailureKind::usage) {  // of many grids some have other attributes and layers
        Finding f = grid_finding(scope, "F162", dataset.why().error.message + ": the boundary representation was not judged");
        use_other_severity(f);
        findings.push_back(std::move(f));
        return {};
    }
    if (!dataset) return std::move(dataset).why();
    if (scope.stopped() || dataset->objects.empty()) return {};
    // Points are shared as they are: layers thinner than the tolerance stay layers.
    auto models = topology::models_to_judge(*dataset, 0);
    if (!models) return std::move(models).why();
    topology::LocalLengths lengths;
    lengths.largest = scope.lengths();
    for (const topology::JudgedModel& judged : *models) {
        const ModelScope model(*dataset, judged, lengths, options);
        judge(scope, GridModel(scope, model, sources), sources, options, findings);
        if (scope.stopped()) return {};
    }
    if (sources.unmatched_columns > 0 && wanted(options, "B05")) {
        findings.push_back(grid_finding(scope, "F162",
                                        "between " + counted(sources.unmatched_columns, "pair", "pairs") +
                                            " of columns sides of cells could not be matched, because cells overlap or are folded (C03, "
                                            "C04, C07, C11): whether regions close was not judged"));
    }
    return {};
}

}  // namespace geomend::validators
