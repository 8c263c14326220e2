// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/object_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/vectors.h"
#include "grid/cell_geometry.h"
#include "validators/cell_findings.h"
#include "validators/places.h"

namespace geomend::validators {

namespace {

bool has_place(const Finding& f) { return !f.points.empty() || !f.polylines.empty(); }

bool is_finite(const Vec3& p) {
    return std::ranges::all_of(p, [](double x) { return std::abs(x) < 1e20; });
}

template <class Points>
Vec3 mean_of_points(const Points& points) {
    Vec3 sum{};
    for (const Vec3& p : points) sum = plus(sum, times(1.0 / static_cast<double>(points.size()), p));
    return sum;
}

/// Adds place(numbers of the element, from 0) for each listed element of `width` numbers, where it gives one.
template <std::size_t width, class Place>
void place_elements(Finding& finding, const Place& place) {
    for (std::size_t e = 0; e + width <= finding.elements.size() && finding.points.size() < listed_elements; e += width) {
        std::array<std::uint32_t, width> at{};
        for (std::size_t n = 0; n < width; ++n) at[n] = static_cast<std::uint32_t>(std::max<std::int64_t>(1, finding.elements[e + n]) - 1);
        const std::optional<Vec3> point = place(at);
        if (point && is_finite(*point)) finding.points.push_back(*point);
    }
}

std::optional<Vec3> middle_of_cell(const GridScope& scope, const std::array<std::uint32_t, 3>& at) {
    const auto& dims = scope.grid().dims;
    if (at[0] >= dims[0] || at[1] >= dims[1] || at[2] >= dims[2]) return std::nullopt;
    Vec3 middle = mean_of_points(scope.corners(at[0], at[1], at[2]));
    middle[2] = 0.0 - middle[2];
    return middle;
}

std::optional<Vec3> top_of_pillar(const CornerPointGrid& grid, const std::array<std::uint32_t, 2>& at) {
    const std::size_t pillar = at[0] + (std::size_t{grid.dims[0]} + 1) * at[1];
    if (at[0] > grid.dims[0] || at[1] > grid.dims[1] || 6 * pillar + 3 > grid.pillars.size()) return std::nullopt;
    return Vec3{grid.pillars[6 * pillar], grid.pillars[6 * pillar + 1], 0.0 - grid.pillars[6 * pillar + 2]};
}

std::optional<Vec3> middle_of_cell(const StructuredGrid& grid, const std::array<std::uint32_t, 3>& at) {
    std::vector<Vec3> corners;
    for (std::uint32_t c = 0; c < 8; ++c) {
        std::array<std::size_t, 3> n{};
        for (std::size_t k = 0; k < 3; ++k) n[k] = std::min<std::size_t>(at[k] + ((c >> k) & 1u), grid.dims[k] - std::size_t{1});
        const std::size_t point = n[0] + grid.dims[0] * (n[1] + std::size_t{grid.dims[1]} * n[2]);
        if (point < grid.points.size()) corners.push_back(grid.points[point]);
    }
    if (corners.empty()) return std::nullopt;
    return mean_of_points(corners);
}

/// Of some points the one nearest to their mean.
std::optional<Vec3> middle_point(std::span<const Vec3> points) {
    if (points.empty()) return std::nullopt;
    const Vec3 mean = mean_of_points(points);
    std::pair best{std::numeric_limits<double>::infinity(), points[0]};
    for (const Vec3& p : points) {
        const Vec3 d = minus(p, mean);
        best = std::min(best, std::pair(dot(d, d), p));
    }
    return best.second;
}

}  // namespace

void give_places(const CellScope& scope, std::span<Finding> findings) {
    const CellMesh& mesh = scope.mesh();
    for (Finding& finding : findings) {
        if (has_place(finding)) continue;
        if (finding.element_kind == "cell") {
            for (const std::int64_t cell : finding.index) {
                if (cell < 0 || static_cast<std::size_t>(cell) >= mesh.types.size() || finding.points.size() >= listed_elements) continue;
                std::vector<Vec3> corners;
                for (const std::uint32_t node : mesh.cell_nodes(static_cast<std::uint32_t>(cell))) corners.push_back(mesh.points[node]);
                if (!corners.empty()) finding.points.push_back(mean_of_points(corners));
            }
        }
        if (const auto middle = middle_point(mesh.points); middle && !has_place(finding)) finding.points.push_back(*middle);
    }
}

void give_places(const GridScope& scope, std::span<Finding> findings) {
    if (!has_geometry(scope.grid()) || scope.grid().pillars.empty() || scope.grid().depths.empty()) return;
    for (Finding& finding : findings) {
        if (has_place(finding)) continue;
        if (finding.element_kind == "cell-ijk")
            place_elements<3>(finding, [&](const std::array<std::uint32_t, 3>& at) { return middle_of_cell(scope, at); });
        else if (finding.element_kind == "column-ij")
            place_elements<2>(finding, [&](const std::array<std::uint32_t, 2>& at) { return middle_of_cell(scope, {at[0], at[1], 0}); });
        else if (finding.element_kind == "pillar-ij")
            place_elements<2>(finding, [&](const std::array<std::uint32_t, 2>& at) { return top_of_pillar(scope.grid(), at); });
    }
}

void place_cells(const CornerPointGrid& grid, Finding& finding) {
    if (grid.cylindrical || grid.pillars.empty() || grid.depths.empty() || !misfit(grid).empty()) return;
    place_elements<3>(finding, [&](const std::array<std::uint32_t, 3>& at) -> std::optional<Vec3> {
        if (at[0] >= grid.dims[0] || at[1] >= grid.dims[1] || at[2] >= grid.dims[2]) return std::nullopt;
        Vec3 middle = mean_of_points(cell_corners(grid, at[0], at[1], at[2]));
        middle[2] = 0.0 - middle[2];
        return middle;
    });
}

void give_places(const ObjectScope& scope, std::span<Finding> findings) {
    const auto* lattice = scope.as<StructuredGrid>();
    for (Finding& finding : findings) {
        if (has_place(finding)) continue;
        if (lattice != nullptr && finding.element_kind == "cell-ijk")
            place_elements<3>(finding, [&](const std::array<std::uint32_t, 3>& at) { return middle_of_cell(*lattice, at); });
        if (has_place(finding)) continue;
        if (const auto middle = middle_point(scope.points())) finding.points.push_back(*middle);
    }
}

}  // namespace geomend::validators
