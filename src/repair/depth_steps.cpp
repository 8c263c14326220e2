// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/wording.h"
#include "repair/grid_steps.h"
#include "validators/cell_findings.h"

// Steps that move corner depths. Columns are independent of each other.

namespace geomend::repair {

namespace {

using validators::FoundCells;
using validators::GridScope;

double& depth(CornerPointGrid& grid, std::size_t cell, unsigned c) {
    const auto [i, j, k] = grid.ijk(cell);
    return grid.depths[corner_index(grid.dims, i, j, k, c)];
}

// Judged cells of a column, downwards.
std::vector<std::size_t> column_cells(const GridScope& scope, std::size_t column) {
    const std::size_t layer = std::size_t{scope.grid().dims[0]} * scope.grid().dims[1];
    std::vector<std::size_t> cells;
    for (std::size_t cell = column; cell < scope.grid().cell_count(); cell += layer) {
        if (scope.judged(cell)) cells.push_back(cell);
    }
    return cells;
}

// Asks change(cells of a column, found) of each column, in parallel; what was found comes in the order of cells.
template <class Change>
FoundCells each_column(const GridScope& scope, const Change& change) {
    const std::size_t columns = std::size_t{scope.grid().dims[0]} * scope.grid().dims[1];
    struct Changed {
        std::size_t cell;
        double by;
    };
    constexpr std::size_t block = 256;
    std::vector<std::vector<Changed>> parts((columns + block - 1) / block);
    parallel_for_each_index(parts.size(), [&](std::size_t b) {
        for (std::size_t column = b * block; column < std::min(columns, (b + 1) * block); ++column)
            change(column_cells(scope, column), [&](std::size_t cell, double by) { parts[b].push_back({cell, by}); });
    });
    std::vector<Changed> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    std::ranges::sort(all, {}, &Changed::cell);
    FoundCells found;
    for (const Changed& c : all) found.add(c.cell, c.by);
    return found;
}

bool same_lines(const CornerPointGrid& grid, std::size_t a, std::size_t b) {
    return grid.reservoirs.empty() || pillar_set(grid, grid.ijk(a)[2]) == pillar_set(grid, grid.ijk(b)[2]);
}

StepReport told(const CornerPointGrid& grid, std::string message, const FoundCells& found, const char* measure) {
    StepReport report;
    report.message = std::move(message);
    validators::list_cells(grid, found, report);
    if (found.count > 0) report.measures = {{measure, found.worst}};
    return report;
}

}  // namespace

StepReport monotone(CornerPointGrid& grid, const GridScope& scope, const StepOptions&) {
    const double tolerance = scope.depth_tolerance();
    const FoundCells found = each_column(scope, [&](const std::vector<std::size_t>& cells, const auto& tell) {
        for (std::size_t n = 0; n < cells.size(); ++n) {
            double most = 0;
            for (unsigned c = 0; c < 4; ++c) {
                const double top = depth(grid, cells[n], c);
                double& bottom = depth(grid, cells[n], c + 4);
                if (bottom >= top) continue;
                // What touched the bottom stays in touch with it.
                if (n + 1 < cells.size() && same_lines(grid, cells[n], cells[n + 1])) {
                    double& next = depth(grid, cells[n + 1], c);
                    if (std::abs(next - bottom) <= tolerance) next = top;
                }
                most = std::max(most, top - bottom);
                bottom = top;
            }
            if (most > 0) tell(cells[n], most);
        }
    });
    return told(grid,
                found.count == 0
                    ? "no bottom lies above its top"
                    : "the bottom of " + counted(found.count, "cell was", "cells was") + " brought down to the top, at most by " +
                          rounded(found.worst) + " in " + validators::cell_text(grid, found.worst_cell),
                found, "largest_move");
}

StepReport close_gaps(CornerPointGrid& grid, const GridScope& scope, const StepOptions& options) {
    const double largest = options.gap.value_or(scope.depth_tolerance());
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    const FoundCells found = each_column(scope, [&](const std::vector<std::size_t>& cells, const auto& tell) {
        for (std::size_t n = 0; n + 1 < cells.size(); ++n) {
            const std::size_t upper = cells[n], lower = cells[n + 1];
            if (!same_lines(grid, upper, lower)) continue;
            double most = 0;
            for (unsigned c = 0; c < 4; ++c) {
                double &bottom = depth(grid, upper, c + 4), &top = depth(grid, lower, c);
                const double distance = top - bottom;
                // Inactive cells fill a gap between cells that are no direct neighbours.
                if (distance == 0 || std::abs(distance) > largest || (distance > 0 && lower != upper + layer)) continue;
                const double highest = depth(grid, upper, c), lowest = depth(grid, lower, c + 4);
                if (highest > lowest) continue;  // there is no depth at which both stay upright
                bottom = top = std::clamp((bottom + top) / 2, highest, lowest);
                most = std::max(most, std::abs(distance));
            }
            if (most > 0) tell(upper, most);
        }
    });
    return told(grid,
                found.count == 0 ? "no gap or overlap up to " + rounded(largest)
                                 : "gaps and overlaps up to " + rounded(largest) + " under " + counted(found.count, "cell", "cells") +
                                       " were closed at the mean, the largest of " + rounded(found.worst) + " under " +
                                       validators::cell_text(grid, found.worst_cell),
                found, "largest_distance");
}

StepReport pinch(CornerPointGrid& grid, const GridScope& scope, const StepOptions&) {
    const double threshold = grid.pinch ? grid.pinch->threshold : CornerPointGrid::Pinch{}.threshold;
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    const FoundCells found = each_column(scope, [&](const std::vector<std::size_t>& cells, const auto& tell) {
        for (std::size_t n = 0; n + 1 < cells.size(); ++n) {
            const std::size_t upper = cells[n], lower = cells[n + 1];
            if (lower == upper + layer || !same_lines(grid, upper, lower)) continue;
            double most = 0;
            bool thin = true;
            for (unsigned c = 0; c < 4; ++c) {
                const double distance = depth(grid, lower, c) - depth(grid, upper, c + 4);
                thin = thin && distance >= 0 && distance <= threshold;
                most = std::max(most, distance);
            }
            if (!thin || most == 0) continue;
            for (unsigned c = 0; c < 4; ++c) {
                const double mean = (depth(grid, lower, c) + depth(grid, upper, c + 4)) / 2;
                depth(grid, upper, c + 4) = depth(grid, lower, c) = mean;
                for (std::size_t between = upper + layer; between < lower; between += layer)
                    depth(grid, between, c) = depth(grid, between, c + 4) = mean;
            }
            tell(upper, most);
        }
    });
    return told(grid,
                found.count == 0 ? "no inactive layer up to " + rounded(threshold) + " lies between active cells"
                                 : "inactive layers up to " + rounded(threshold) + " under " + counted(found.count, "cell", "cells") +
                                       " were closed at the mean, the thickest of " + rounded(found.worst),
                found, "largest_distance");
}

StepReport depth_sign(CornerPointGrid& grid, const GridScope& scope, const StepOptions&) {
    // Most cells have their mean bottom above their mean top.
    const auto upward = validators::find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return validators::Judgement{grid::thickness(scope.corners(i, j, k)) < 0};
    });
    StepReport report;
    report.element_kind = "cell-ijk";
    if (2 * upward.count <= scope.judged_count()) {
        report.message = "layers go downwards: the sign of depth is right";
        return report;
    }
    const auto turn = [](double& z) { z = 0.0 - z; };
    std::ranges::for_each(grid.depths, turn);
    for (std::size_t z = 2; z < grid.pillars.size(); z += 3) turn(grid.pillars[z]);
    report.count = grid.cell_count();
    report.message = "layers went upwards: all depths have the opposite sign now";
    return report;
}

}  // namespace geomend::repair
