// SPDX-License-Identifier: AGPL-3.0-or-later
// Slits between cells: outer faces that face each other across a gap much narrower than the cells are wide.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/parallel.h"
#include "base/wording.h"
#include "geometry/triangle_tree.h"
#include "geometry/vectors.h"
#include "validators/cell_checks.h"
#include "validators/cell_findings.h"
#include "validators/outer_faces.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

/// A slit is narrower than this share of the faces at it. Between faces of hexahedra or wedges that look up and down layers of inactive
/// cells may have been left out: there only the search length counts.
constexpr double narrow_share = 0.05;

using Corners3 = std::array<Vec3, 3>;

struct AcrossGap {
    std::uint32_t cell;
    Vec3 place;
    double gap;
};

double longest_edge(const Corners3& t) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 e = minus(t[(i + 1) % 3], t[i]);
        longest = std::max(longest, dot(e, e));
    }
    return std::sqrt(longest);
}

Vec3 centre_of(const Corners3& t) { return times(1.0 / 3, plus(t[0], plus(t[1], t[2]))); }

/// How far a point lies above a triangle, on the side to which its normal points.
double height_above(const Corners3& t, const Vec3& normal, const Vec3& point) {
    return dot(minus(point, t[0]), normal) / std::sqrt(dot(normal, normal));
}

bool is_layered(const CellScope& scope, std::uint32_t cell) {
    const CellType type = linear_type(scope.mesh().types[cell]);
    return type == CellType::hexahedron || type == CellType::wedge || type == CellType::polyhedron;
}

bool share_a_corner(const Triangle& a, const Triangle& b) {
    return std::ranges::any_of(a, [&](std::uint32_t v) { return std::ranges::find(b, v) != b.end(); });
}

/// Looks at pairs of outer triangles.
class Gaps {
public:
    explicit Gaps(const CellScope& scope) : scope_(scope), outer_(outer_faces(scope)), tree_(scope.mesh().points, outer_.triangles) {}

    /// Both sides of all slits, by cells, each cell with its narrowest one.
    std::vector<AcrossGap> find() const {
        std::vector<std::vector<AcrossGap>> parts((tree_.size() + 1023) / 1024);
        parallel_for_each_index(parts.size(), [&](std::size_t part) {
            for (std::size_t i = 1024 * part; i < std::min(tree_.size(), 1024 * (part + 1)) && !scope_.stopped(); ++i)
                look_around(i, parts[part]);
        });
        std::vector<AcrossGap> all;
        for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
        std::ranges::sort(all, [](const AcrossGap& a, const AcrossGap& b) {
            return std::pair(a.cell, std::pair(a.gap, a.place)) < std::pair(b.cell, std::pair(b.gap, b.place));
        });
        const auto rest = std::ranges::unique(all, {}, &AcrossGap::cell);
        all.erase(rest.begin(), rest.end());
        return all;
    }

private:
    const CellScope& scope_;
    OuterFaces outer_;
    TriangleTree tree_;

    Corners3 corners(std::size_t i) const {
        const Triangle& t = tree_.triangle(i);
        const auto& points = scope_.mesh().points;
        return {points[t[0]], points[t[1]], points[t[2]]};
    }
    const OuterTriangle& of(std::size_t i) const { return outer_.of[tree_.number(i)]; }
    std::uint32_t cell_at(std::size_t i) const { return scope_.faces()[of(i).face].cell; }

    double widest(std::size_t i, std::size_t j, const Corners3& a, const Corners3& b) const {
        const double by_rule = scope_.lengths().near;
        const Vec3& n = of(i).normal;
        const bool looks_up_or_down = 2 * n[2] * n[2] > dot(n, n);
        if (looks_up_or_down && (is_layered(scope_, cell_at(i)) || is_layered(scope_, cell_at(j)))) return by_rule;
        return std::max(by_rule, narrow_share * std::min(longest_edge(a), longest_edge(b)));
    }

    void look_around(std::size_t i, std::vector<AcrossGap>& found) const {
        const Corners3 a = corners(i);
        const double reach = std::max(scope_.lengths().near, narrow_share * longest_edge(a));
        const Bounds around = bounds_around(a);
        tree_.visit_triangles(tree_.box(around.low, around.high, reach), [&](std::size_t j) {
            if (j <= i || cell_at(i) == cell_at(j) || share_a_corner(tree_.triangle(i), tree_.triangle(j))) return;
            if (dot(of(i).normal, of(j).normal) >= 0) return;
            const Corners3 b = corners(j);
            const double limit = widest(i, j, a, b);
            const bool a_is_smaller = dot(of(i).normal, of(i).normal) < dot(of(j).normal, of(j).normal);
            const double gap = a_is_smaller ? height_above(b, of(j).normal, centre_of(a)) : height_above(a, of(i).normal, centre_of(b));
            if (!(gap > scope_.lengths().tolerance && gap <= limit) || !lie_on_each_other(a, b, limit)) return;
            const Vec3 place = a_is_smaller ? centre_of(a) : centre_of(b);
            found.push_back({cell_at(i), place, gap});
            found.push_back({cell_at(j), place, gap});
        });
    }
};

}  // namespace

void check_cell_gaps(const CellScope& scope, std::vector<Finding>& findings) {
    if (scope.volume_cells().size() < 2) return;
    const auto found = Gaps(scope).find();
    if (found.empty()) return;
    std::vector<std::uint32_t> cells;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const AcrossGap& one : found) {
        cells.push_back(one.cell);
        least = std::min(least, one.gap);
        most = std::max(most, one.gap);
    }
    const std::string width = rounded(least) == rounded(most) ? rounded(least) : rounded(least) + " to " + rounded(most);
    Finding finding =
        cells_of_mesh_finding(scope, "M38",
                              counted(cells.size(), "cell", "cells") + in_mesh(scope) + (cells.size() == 1 ? " faces" : " face") +
                                  " others across a slit of " + width + " that no cell fills: nothing flows through it",
                              cells);
    finding.points.clear();
    for (const AcrossGap& one : found) {
        if (finding.points.size() < listed_elements) finding.points.push_back(one.place);
    }
    finding.measures = {{"narrowest", least}, {"widest", most}};
    findings.push_back(std::move(finding));
}

}  // namespace geomend::validators
