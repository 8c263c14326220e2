// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>

#include "validators/corner_point.h"

// What the pillars say: C10 and C11.

namespace geomend::validators {

namespace {

using Direction = std::array<double, 2>;

double tilt_of(const Direction& d) { return std::hypot(d[0], d[1]); }

// Judged cells of one column that use one set of coordinate lines.
struct Column {
    std::uint32_t i = 0, j = 0;
    std::vector<std::uint32_t> layers;
};

// From one pillar to another at a depth, seen from above.
Direction between(const double* a, const double* b, double depth) {
    const Vec3 p = pillar_point(a, depth), q = pillar_point(b, depth);
    return {q[0] - p[0], q[1] - p[1]};
}

// The depth at which two pillars pass each other between two depths: there they touch, or the way from one to the other
// has turned round (by more than 90 degrees). Nothing where they run together, or meet at an end only.
std::optional<double> crossing(const double* a, const double* b, double upper, double lower, double tolerance) {
    if (!(lower > upper)) return {};
    const Direction first = between(a, b, upper), last = between(a, b, lower);
    if (tilt_of(first) <= tolerance || tilt_of(last) <= tolerance) return {};
    const Direction change{last[0] - first[0], last[1] - first[1]};
    const double square = change[0] * change[0] + change[1] * change[1];
    if (square == 0) return {};
    const double t = -(first[0] * change[0] + first[1] * change[1]) / square;
    if (!(t > 0 && t < 1)) return {};
    const Direction nearest{first[0] + t * change[0], first[1] + t * change[1]};
    const bool turned = first[0] * last[0] + first[1] * last[1] < 0;
    if (!turned && tilt_of(nearest) > tolerance) return {};
    return upper + t * (lower - upper);
}

// Adds to `crossed` the cells of a column that lie around a crossing of two of its pillars.
void judge_column(const GridScope& scope, const Column& column, const double* set, std::vector<std::size_t>& crossed) {
    // The four sides of the outline and its two diagonals.
    constexpr std::array<std::array<unsigned, 2>, 6> pairs{{{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}}};
    const auto& grid = scope.grid();
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    const auto depth = [&](std::uint32_t k, unsigned c) { return scope.depth(column.i, column.j, k, c); };
    for (const auto& [c, d] : pairs) {
        double upper = depth(column.layers.front(), c), lower = upper;
        for (const std::uint32_t k : column.layers) {
            upper = std::min({upper, depth(k, c), depth(k, d), depth(k, c + 4), depth(k, d + 4)});
            lower = std::max({lower, depth(k, c), depth(k, d), depth(k, c + 4), depth(k, d + 4)});
        }
        const auto pillar = [&](unsigned corner) {
            return set + 6 * (column.i + (corner & 1u) + lines * (std::size_t{column.j} + (corner >> 1)));
        };
        const auto at = crossing(pillar(c), pillar(d), upper, lower, scope.tolerance());
        if (!at) continue;
        // The first cell that reaches down to the crossing holds it, or lies next to it.
        const auto holds =
            std::ranges::find_if(column.layers, [&](std::uint32_t k) { return std::max(depth(k, c + 4), depth(k, d + 4)) >= *at; });
        const std::uint32_t k = holds == column.layers.end() ? column.layers.back() : *holds;
        const std::size_t cell = grid.cell(column.i, column.j, k);
        if (std::ranges::find(crossed, cell) == crossed.end()) crossed.push_back(cell);
    }
}

// Pillars that corners of judged cells lie on.
std::vector<std::uint8_t> used_pillars(const GridScope& scope) {
    const auto& grid = scope.grid();
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    std::vector<std::uint8_t> used(grid.pillars.size() / 6, 0);
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
        if (!scope.judged(cell)) continue;
        const auto [i, j, k] = grid.ijk(cell);
        const std::size_t from = (grid.reservoirs.empty() ? 0 : pillar_set(grid, k) * pillar_count(grid.dims)) + i + lines * j;
        used[from] = used[from + 1] = used[from + lines] = used[from + lines + 1] = 1;
    }
    return used;
}

}  // namespace

void check_flat_pillars(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    const std::vector<std::uint8_t> used = used_pillars(scope);
    const std::size_t lines = std::size_t{grid.dims[0]} + 1, set = pillar_count(grid.dims);
    Finding f = grid_finding(scope, "C10", {});
    f.element_kind = "pillar-ij";
    double worst = 0;
    for (std::size_t p = 0; p < used.size(); ++p) {
        const double* v = grid.pillars.data() + 6 * p;
        const double apart = std::hypot(v[3] - v[0], v[4] - v[1]);
        if (used[p] == 0 || std::abs(v[5] - v[2]) > scope.depth_tolerance() || apart <= scope.tolerance()) continue;
        ++f.count;
        worst = std::max(worst, apart);
        if (f.index.size() == listed_elements) continue;
        f.elements.push_back(static_cast<std::int64_t>(p % set % lines) + 1);
        f.elements.push_back(static_cast<std::int64_t>(p % set / lines) + 1);
        f.index.push_back(static_cast<std::int64_t>(p));
    }
    if (f.count == 0) return;
    f.message = "the two points of " + counted(f.count, "pillar have", "pillars have") + " the same depth, but lie up to " +
                rounded(worst) + " apart: which way the pillar runs is not stated";
    f.measures = {{"distance", worst}};
    findings.push_back(std::move(f));
}

void check_crossing_pillars(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    std::vector<std::vector<std::size_t>> rows(grid.dims[1]);
    parallel_for_each_index(rows.size(), [&](std::size_t row) {
        Column column;
        column.j = static_cast<std::uint32_t>(row);
        const std::size_t sets = std::max<std::size_t>(1, grid.reservoirs.size());
        for (column.i = 0; column.i < grid.dims[0] && !scope.stopped(); ++column.i) {
            for (std::size_t set = 0; set < sets; ++set) {
                column.layers.clear();
                for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
                    if (scope.judged(grid.cell(column.i, column.j, k)) && (sets == 1 || pillar_set(grid, k) == set))
                        column.layers.push_back(k);
                }
                if (!column.layers.empty()) judge_column(scope, column, grid.pillars.data() + 6 * set * pillar_count(grid.dims), rows[row]);
            }
        }
    });
    std::vector<std::size_t> cells;
    for (const auto& row : rows) cells.insert(cells.end(), row.begin(), row.end());
    if (cells.empty()) return;
    std::ranges::sort(cells);
    FoundCells found;
    for (const std::size_t cell : cells) found.add(cell, 0);
    findings.push_back(cells_finding(scope, "C11", "pillars cross within " + counted(found.count, "active cell", "active cells"), found));
}

}  // namespace geomend::validators
