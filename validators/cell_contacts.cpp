// SPDX-License-Identifier: AGPL-3.0-or-later
// What parts of a mesh of cells have in common where no face joins them: faces that lie on each other, edges and corners.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "base/bounds.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/wording.h"
#include "geometry/triangle_tree.h"
#include "geometry/vectors.h"
#include "topology/faces_from_mesh.h"
#include "topology/near_weld.h"
#include "validators/cell_checks.h"
#include "validators/cell_regions.h"
#include "validators/outer_faces.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Whether one of two faces has all corners of the other: triangles over either diagonal of a quadrangle, however bent it is.
bool is_part_of(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    return a.size() < b.size() ? std::ranges::includes(b, a) : std::ranges::includes(a, b);
}

/// Pairs of triangles of different cells that lie on each other from both sides, ascending. Faces whose nodes are the same within the
/// tolerance match: that their nodes are not one is M27.
std::vector<Pair> facing_pairs(const CellScope& scope, const OuterFaces& outer) {
    const auto& points = scope.mesh().points;
    const double tolerance = scope.lengths().tolerance;
    const auto near = tolerance > 0 ? topology::clusters_within(points, tolerance) : std::vector<std::uint32_t>{};
    const auto vertices_of = [&](std::uint32_t face) {
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t node : scope.nodes_of(scope.faces()[face])) {
            const std::uint32_t v = scope.vertex_of()[node];
            vertices.push_back(near.empty() ? v : near[v]);
        }
        std::ranges::sort(vertices);
        return vertices;
    };
    const auto corners = [&](const Triangle& t) { return std::array{points[t[0]], points[t[1]], points[t[2]]}; };
    const TriangleTree tree(points, outer.triangles);
    std::vector<std::vector<Pair>> parts((tree.size() + 1023) / 1024);
    parallel_for_each_index(parts.size(), [&](std::size_t part) {
        for (std::size_t i = 1024 * part; i < std::min(tree.size(), 1024 * (part + 1)) && !scope.stopped(); ++i) {
            const auto a = corners(tree.triangle(i));
            const OuterTriangle& own = outer.of[tree.number(i)];
            const Bounds around = bounds_around(a);
            tree.visit_triangles(tree.box(around.low, around.high, tolerance), [&](std::size_t j) {
                const OuterTriangle& other = outer.of[tree.number(j)];
                if (j <= i || scope.faces()[own.face].cell == scope.faces()[other.face].cell) return;
                if (dot(own.normal, other.normal) >= 0) return;
                const auto mine = vertices_of(own.face), theirs = vertices_of(other.face);
                if (mine == theirs) return;
                if (!lie_on_each_other(a, corners(tree.triangle(j)), tolerance) && !is_part_of(mine, theirs)) return;
                parts[part].push_back(std::minmax(tree.number(i), tree.number(j)));
            });
        }
    });
    std::vector<Pair> pairs;
    for (const auto& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
    std::ranges::sort(pairs);
    return pairs;
}

void tell_unmatched(const CellScope& scope, const OuterFaces& outer, const std::vector<Pair>& pairs, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> cells;
    for (const auto& [a, b] : pairs) {
        cells.push_back(scope.faces()[outer.of[a].face].cell);
        cells.push_back(scope.faces()[outer.of[b].face].cell);
    }
    if (cells.empty()) return;
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    Finding finding = cells_of_mesh_finding(scope, "M24",
                                            counted(cells.size(), "cell", "cells") + in_mesh(scope) +
                                                (cells.size() == 1 ? " lies" : " lie") + " face to face with others without matching faces",
                                            cells);
    finding.measures = {{"pairs_of_triangles", static_cast<double>(pairs.size())}};
    findings.push_back(std::move(finding));
}

/// Takes off the marks of nodes at which no two parts of one region meet, where regions are stated: different ones may touch anywhere.
template <class EachCorner>
void leave_contacts_of_regions(const CellScope& scope, DisjointSets& parts, const EachCorner& each_corner,
                               std::vector<std::uint8_t>& meets) {
    const auto region = stated_regions_of_cells(scope);
    if (region.empty()) return;
    std::vector<std::tuple<std::uint32_t, std::int64_t, std::uint32_t>> at_nodes;  // node, region, part
    for (const std::uint32_t cell : scope.volume_cells()) {
        each_corner(cell, [&](std::uint32_t v) {
            if (meets[v] != 0) at_nodes.emplace_back(v, region[cell], parts.root(cell));
        });
    }
    std::ranges::sort(at_nodes);
    at_nodes.erase(std::unique(at_nodes.begin(), at_nodes.end()), at_nodes.end());
    std::ranges::fill(meets, std::uint8_t{0});
    for (std::size_t i = 1; i < at_nodes.size(); ++i) {
        const auto &a = at_nodes[i - 1], &b = at_nodes[i];
        if (std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b)) meets[std::get<0>(b)] = 1;
    }
}

/// Cells at nodes at which parts of one region, or of a mesh without regions, meet that neither faces nor pairs of facing triangles join.
void tell_loose_contacts(const CellScope& scope, const OuterFaces& outer, const std::vector<Pair>& pairs, std::vector<Finding>& findings) {
    DisjointSets parts(scope.mesh().cell_count());
    const auto groups = scope.group_first();
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        for (std::uint32_t k = groups[g] + 1; k < groups[g + 1]; ++k) {
            parts.join(scope.faces()[scope.grouped()[groups[g]]].cell, scope.faces()[scope.grouped()[k]].cell);
        }
    }
    for (const auto& [a, b] : pairs) parts.join(scope.faces()[outer.of[a].face].cell, scope.faces()[outer.of[b].face].cell);
    std::vector<std::uint32_t> part_at(scope.mesh().points.size(), no_index);
    std::vector<std::uint8_t> meets(scope.mesh().points.size(), 0);
    const auto each_corner = [&](std::uint32_t cell, const auto& visit) {
        for (const std::uint32_t node : topology::corner_nodes(scope.mesh(), cell)) visit(scope.vertex_of()[node]);
    };
    for (const std::uint32_t cell : scope.volume_cells()) {
        const std::uint32_t part = parts.root(cell);
        each_corner(cell, [&](std::uint32_t v) {
            if (part_at[v] == no_index) part_at[v] = part;
            else if (part_at[v] != part) meets[v] = 1;
        });
    }
    leave_contacts_of_regions(scope, parts, each_corner, meets);
    std::vector<std::uint32_t> cells;
    bool has_tetrahedra = false;
    for (const std::uint32_t cell : scope.volume_cells()) {
        bool is_there = false;
        each_corner(cell, [&](std::uint32_t v) { is_there |= meets[v] != 0; });
        if (!is_there) continue;
        cells.push_back(cell);
        has_tetrahedra |= linear_type(scope.mesh().types[cell]) == CellType::tetrahedron;
    }
    if (cells.empty()) return;
    Finding finding = cells_of_mesh_finding(
        scope, "M36",
        counted(cells.size(), "cell", "cells") + in_mesh(scope) + " meet others at edges or corners only: no face joins their parts",
        cells);
    if (!has_tetrahedra) use_other_severity(finding);
    const auto nodes = static_cast<double>(std::ranges::count(meets, 1));
    finding.measures = {{"nodes", nodes}};
    findings.push_back(std::move(finding));
}

}  // namespace

void check_cell_contacts(const CellScope& scope, std::vector<Finding>& findings) {
    const OuterFaces outer = outer_faces(scope);
    const auto pairs = facing_pairs(scope, outer);
    tell_unmatched(scope, outer, pairs, findings);
    tell_loose_contacts(scope, outer, pairs, findings);
    std::vector<std::array<std::uint32_t, 2>> facing;
    for (const auto& [a, b] : pairs) facing.push_back({scope.faces()[outer.of[a].face].cell, scope.faces()[outer.of[b].face].cell});
    check_cell_regions(scope, facing, findings);
}

}  // namespace geomend::validators
