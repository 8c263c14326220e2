// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/length.h"
#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "geometry/corner_frames.h"
#include "geometry/lattice_cells.h"
#include "validators/cell_findings.h"
#include "validators/object_checks.h"

namespace geomend::validators {

namespace {

/// A structured grid with cells of three dimensions; nullptr where the object is none.
const StructuredGrid* solid_lattice(const ObjectScope& scope) {
    const auto* grid = scope.as<StructuredGrid>();
    const bool solid = grid != nullptr && std::ranges::all_of(grid->dims, [](std::uint32_t n) { return n > 1; }) &&
                       grid->points.size() == sample_count(grid->dims);
    return solid ? grid : nullptr;
}

/// Asks judge(corners) -> Judgement of each cell that is not blanked, in parallel.
template <class Judge>
FoundCells find_lattice_cells(const ObjectScope& scope, const LatticeCells& cells, const Judge& judge) {
    constexpr std::size_t block = 8192;
    std::vector<FoundCells> parts((cells.count() + block - 1) / block);
    parallel_for_each_index(parts.size(), [&](std::size_t b) {
        if (scope.stopped()) return;
        for (std::size_t c = b * block, last = std::min(cells.count(), (b + 1) * block); c < last; ++c) {
            if (cells.is_dead(c)) continue;
            const Judgement j = judge(cells.corners(c));
            if (j.found) parts[b].add(c, j.measure, j.kind);
        }
    });
    FoundCells all;
    for (const FoundCells& part : parts) all.append(part);
    return all;
}

/// +1 or -1: the sign that the volumes of most cells have.
double majority_sign(const ObjectScope& scope, const LatticeCells& cells) {
    const FoundCells signs = find_lattice_cells(scope, cells, [](const std::array<Vec3, 8>& corners) {
        const double v = hexahedron_volume(corners);
        return Judgement{v != 0, 0, v < 0 ? 1u : 0u};
    });
    return signs.by_kind[1] > signs.by_kind[0] ? -1 : 1;
}

/// The least determinant of the edges at a corner, beyond what moving its ends by the tolerance explains, as a part of the
/// product of the edges' lengths; 0 where none is negative.
double worst_corner(const std::array<Vec3, 8>& p, double sign, double tolerance) {
    double worst = 0;
    for (const auto& f : corner_frames(CellType::hexahedron)) {
        const Vec3 a = minus(p[f[1]], p[f[0]]), b = minus(p[f[2]], p[f[0]]), c = minus(p[f[3]], p[f[0]]);
        const double la = length(a), lb = length(b), lc = length(c);
        const double explained = 2 * tolerance * (la * lb + lb * lc + lc * la);
        const double determinant = sign * dot(a, cross(b, c));
        if (determinant < -explained) worst = std::min(worst, determinant / (la * lb * lc));
    }
    return worst;
}

Finding lattice_finding(const ObjectScope& scope, const LatticeCells& cells, std::string_view code, std::string message,
                        const FoundCells& found) {
    Finding finding = object_finding(scope, code, std::move(message));
    finding.count = found.count;
    finding.element_kind = "cell-ijk";
    for (const std::size_t c : found.first) {
        for (const std::size_t n : cells.ijk(c)) finding.elements.push_back(static_cast<std::int64_t>(n) + 1);
        finding.index.push_back(static_cast<std::int64_t>(c));
    }
    return finding;
}

}  // namespace

void check_lattice_cells(const ObjectScope& scope, std::vector<Finding>& findings) {
    const StructuredGrid* grid = solid_lattice(scope);
    if (grid == nullptr) return;
    const LatticeCells cells(*grid);
    const double sign = majority_sign(scope, cells), tolerance = scope.lengths().tolerance, least = std::pow(tolerance, 3);
    const FoundCells turned = find_lattice_cells(scope, cells, [&](const std::array<Vec3, 8>& corners) {
        return Judgement{sign * hexahedron_volume(corners) < -least, 0, 0};
    });
    const FoundCells empty = find_lattice_cells(scope, cells, [&](const std::array<Vec3, 8>& corners) {
        return Judgement{std::abs(hexahedron_volume(corners)) <= least, 0, 0};
    });
    const FoundCells folded = find_lattice_cells(scope, cells, [&](const std::array<Vec3, 8>& corners) {
        if (sign * hexahedron_volume(corners) <= least) return Judgement{};  // M20
        const double worst = worst_corner(corners, sign, tolerance);
        return Judgement{worst < 0, -worst, 0};
    });
    if (turned.count > 0) {
        findings.push_back(lattice_finding(scope, cells, "M20",
                                           counted(turned.count, "cell", "cells") + of_object(scope) +
                                               (turned.count == 1 ? " is" : " are") + " inside out, unlike the others",
                                           turned));
    }
    if (empty.count > 0) {
        // Layers that pinch out are drawn so on purpose.
        findings.push_back(lattice_finding(
            scope, cells, "M20",
            counted(empty.count, "cell", "cells") + of_object(scope) + (empty.count == 1 ? " has no volume" : " have no volume"), empty));
        use_other_severity(findings.back());
        findings.back().measures.emplace_back("pinched", static_cast<double>(empty.count));
    }
    if (folded.count > 0) {
        findings.push_back(lattice_finding(
            scope, cells, "M21",
            counted(folded.count, "cell", "cells") + of_object(scope) + (folded.count == 1 ? " is" : " are") +
                " folded at a corner (worst determinant of its edges " + rounded(-folded.worst) + " of the product of their lengths)",
            folded));
        findings.back().measures = {{"jacobian", -folded.worst}};
    }
}

void check_lattice_layers(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* grid = scope.as<StructuredGrid>();
    if (grid == nullptr || grid->points.size() != sample_count(grid->dims)) return;
    const std::array<std::size_t, 3> dims{grid->dims[0], grid->dims[1], grid->dims[2]}, stride{1, dims[0], dims[0] * dims[1]};
    const double square = scope.lengths().tolerance * scope.lengths().tolerance;
    std::string where;
    std::uint64_t count = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::vector<std::uint8_t> repeats(dims[axis] - 1, 0);
        parallel_for_each_index(repeats.size(), [&](std::size_t layer) {
            for (std::size_t i = 0; i < dims[u]; ++i) {
                for (std::size_t j = 0; j < dims[v]; ++j) {
                    const std::size_t at = layer * stride[axis] + i * stride[u] + j * stride[v];
                    const Vec3 d = minus(grid->points[at], grid->points[at + stride[axis]]);
                    if (!(dot(d, d) <= square)) return;
                }
            }
            repeats[layer] = 1;
        });
        for (std::size_t layer = 0; layer < repeats.size(); ++layer) {
            if (repeats[layer] == 0) continue;
            if (count++ == 0) where = std::to_string(layer + 1) + " along " + "ijk"[axis];
        }
    }
    if (count == 0) return;
    Finding finding = object_finding(scope, "M50",
                                     counted(count, "layer", "layers") + of_object(scope) + (count == 1 ? " has" : " have") +
                                         " no thickness: the first one is layer " + where);
    finding.count = count;
    findings.push_back(std::move(finding));
}

}  // namespace geomend::validators
