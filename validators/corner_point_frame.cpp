// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "grid/map_axes.h"
#include "validators/corner_point.h"

// What the grid's frame says: C12, C13 and C19.

namespace geomend::validators {

namespace {

using grid::Corners;

// Signed area of the outline seen from above, mean of top and base: positive where (I, J, K) is right-handed. 0 where it
// is as small as the tolerance makes it.
double outline(const Corners& p, double tolerance) {
    std::array<std::array<double, 2>, 4> q;
    for (unsigned c = 0; c < 4; ++c) q[c] = {(p[c][0] + p[c + 4][0]) / 2, (p[c][1] + p[c + 4][1]) / 2};
    const double area = ((q[3][0] - q[0][0]) * (q[2][1] - q[1][1]) - (q[3][1] - q[0][1]) * (q[2][0] - q[1][0])) / 2;
    const double across = std::hypot(q[3][0] - q[0][0], q[3][1] - q[0][1]) + std::hypot(q[2][0] - q[1][0], q[2][1] - q[1][1]);
    return std::abs(area) <= tolerance * across ? 0 : area;
}

// Twice the area that the unit vectors of the map's axes span; 0 where an axis has no length.
double map_turn(const std::array<double, 6>& m) {
    const double ux = m[4] - m[2], uy = m[5] - m[3], vx = m[0] - m[2], vy = m[1] - m[3];
    const double u = std::hypot(ux, uy), v = std::hypot(vx, vy);
    return u < 1e-5 || v < 1e-5 ? 0 : (ux * vy - uy * vx) / (u * v);
}

double through_float(double v) { return static_cast<double>(static_cast<float>(v)); }

}  // namespace

void check_handedness(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    const auto area = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return outline(scope.corners(i, j, k), scope.tolerance()); };
    const FoundCells all = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const double a = area(i, j, k);
        return Judgement{a != 0, 0, a > 0 ? 1u : 0u};
    });
    const std::uint64_t left = all.by_kind[0], right = all.by_kind[1];
    if (left > 0 && right > 0) {
        const double sign = left <= right ? -1 : 1;
        const FoundCells fewer = find_cells(
            scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) { return Judgement{sign * area(i, j, k) > 0}; });
        Finding f = cells_finding(scope, "C12",
                                  std::to_string(right) + " cells are right-handed in (x, y, depth) and " + std::to_string(left) +
                                      " left-handed: the minority is listed",
                                  fewer);
        f.measures = {{"right_handed", static_cast<double>(right)}, {"left_handed", static_cast<double>(left)}};
        findings.push_back(std::move(f));
        return;
    }
    const bool mirrored = grid.map_axes && !grid.map_relative && map_turn(*grid.map_axes) < 0;
    if (left == 0 && !(mirrored && right > 0)) return;
    std::string message = left > 0 ? "all cells are left-handed in (x, y, depth)"
                                   : "the cells are right-handed in the axes of the file, but left-handed on the map";
    if (mirrored) message += left > 0 ? ", but right-handed on the map, because MAPAXES mirrors" : ", because MAPAXES mirrors";
    Finding f = grid_finding(scope, "C12", std::move(message));
    use_other_severity(f);
    f.count = std::max(left, right);
    f.measures = {{"right_handed", static_cast<double>(right)}, {"left_handed", static_cast<double>(left)}};
    findings.push_back(std::move(f));
}

void check_map_axes(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    std::string what;
    const auto tell_unit = [&](const std::string& unit, const char* keyword) {
        if (unit.empty() || (grid::metres(unit) > 0 && grid::metres(unit) != 1200.0 / 3937)) return;
        what += std::string(what.empty() ? "" : "; ") + "'" + unit + "' of " + keyword +
                " is not a unit that simulators know (METRES, FEET, CM)";
    };
    tell_unit(grid.map_unit, "MAPUNITS");
    if (grid::metres(grid.info.crs.axis_units[0]) == 0) tell_unit(grid.info.crs.axis_units[0], "the axes (GRIDUNIT)");
    if (!grid.map_axes) {
        if (!what.empty()) findings.push_back(grid_finding(scope, "C13", std::move(what)));
        return;
    }
    if (std::abs(map_turn(*grid.map_axes)) < 1e-5)
        what += std::string(what.empty() ? "" : "; ") + "the three points of MAPAXES lie on one line or coincide: the map has no axes";
    if (grid.map_unit.empty()) what += std::string(what.empty() ? "" : "; ") + "MAPAXES is given, but MAPUNITS is not";
    if (!what.empty()) findings.push_back(grid_finding(scope, "C13", std::move(what)));
}

void check_single_precision(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    if (grid.info.precision == CoordinatePrecision::single_precision) return;  // what is read from single precision has lost nothing more
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const double* set = grid.pillars.data() + 6 * pillar_count(grid.dims) * (grid.reservoirs.empty() ? 0 : pillar_set(grid, k));
        double worst = 0;
        for (unsigned c = 0; c < 8; ++c) {
            const double* pillar = set + 6 * (i + (c & 1u) + lines * (std::size_t{j} + ((c >> 1) & 1u)));
            std::array<double, 6> stored;
            std::transform(pillar, pillar + 6, stored.begin(), through_float);
            const double depth = scope.depth(i, j, k, c), stored_depth = through_float(depth);
            const Vec3 p = pillar_point(pillar, depth, grid.cylindrical), q = pillar_point(stored.data(), stored_depth, grid.cylindrical);
            worst = std::max(worst, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        }
        return Judgement{worst > scope.tolerance(), worst};
    });
    if (found.count == 0) return;
    Finding f = cells_finding(scope, "C19",
                              "single precision, as EGRID, GRID and ROFF files have it, moves corners of " +
                                  counted(found.count, "cell", "cells") + " by up to " + rounded(found.worst) + " (" +
                                  cell_text(grid, found.worst_cell) + "), more than the tolerance of " + rounded(scope.tolerance()) +
                                  "; written with --option origin=local, coordinates count from a round origin near the grid",
                              found);
    f.measures = {{"shift", found.worst}};
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
