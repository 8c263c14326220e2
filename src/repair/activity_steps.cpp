// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/wording.h"
#include "grid/pore_volume.h"
#include "repair/grid_steps.h"
#include "validators/corner_point.h"

// Steps that make cells inactive. Cells keep their numbers, so that faults and connections stay as they are; stated
// connections that lead to a cell which is no longer there for the simulator are told.

namespace geomend::repair {

namespace {

using validators::FoundCells;
using validators::GridScope;

// Makes cells inactive and tells of them. \param what e.g. "without thickness"
StepReport drop(CornerPointGrid& grid, const std::vector<std::size_t>& cells, const std::string& what) {
    StepReport report;
    FoundCells found;
    if (!cells.empty() && grid.activity.empty()) grid.activity.assign(grid.cell_count(), 1);
    std::vector<bool> dropped(cells.empty() ? 0 : grid.cell_count(), false);
    for (const std::size_t cell : cells) {
        found.add(cell, 0);
        grid.activity[cell] = 0;
        dropped[cell] = true;
    }
    validators::list_cells(grid, found, report);
    report.message = cells.empty() ? "no active cell is " + what
                                   : counted(found.count, "active cell", "active cells") + " that " + (cells.size() == 1 ? "is " : "are ") +
                                         what + " became inactive";
    if (cells.empty()) return report;
    const auto leads = [&](std::uint64_t cell) { return dropped[cell % grid.cell_count()]; };
    const auto connections = std::ranges::count_if(grid.connections, [&](const auto& c) { return leads(c.first) || leads(c.second); });
    if (connections > 0) {
        report.message += "; " + counted(static_cast<std::uint64_t>(connections), "stated connection leads", "stated connections lead") +
                          " to them and stay as stated";
        report.measures = {{"connections_to_them", static_cast<double>(connections)}};
    }
    return report;
}

template <class Judge>
std::vector<std::size_t> active_cells(const GridScope& scope, const Judge& judge) {
    std::vector<std::size_t> cells;
    for (std::size_t cell = 0; cell < scope.grid().cell_count(); ++cell) {
        if (scope.judged(cell) && scope.grid().is_active(cell) && judge(cell)) cells.push_back(cell);
    }
    return cells;
}

}  // namespace

StepReport drop_collapsed(CornerPointGrid& grid, const GridScope& scope, const StepOptions&) {
    const auto collapsed = [&](std::size_t cell) {
        const auto [i, j, k] = grid.ijk(cell);
        for (unsigned c = 0; c < 4; ++c) {
            if (std::abs(scope.depth(i, j, k, c + 4) - scope.depth(i, j, k, c)) > scope.depth_tolerance()) return false;
        }
        return true;
    };
    return drop(grid, active_cells(scope, collapsed), "without thickness");
}

StepReport drop_isolated(CornerPointGrid& grid, const GridScope& scope, const StepOptions&) {
    return drop(grid, validators::isolated_cells(scope), "without active neighbour");
}

StepReport minpv(CornerPointGrid& grid, const GridScope& scope, const StepOptions&) {
    if (!grid::knows_pore_volumes(grid)) {
        StepReport report;
        report.message = "pore volumes are not known: neither PORO nor PORV is there";
        return report;
    }
    const std::vector<double> volumes = grid::pore_volumes(grid), own = grid::fitting_values(grid, "MINPVV", 0);
    const double least = grid::least_pore_volume(grid);
    return drop(grid, active_cells(scope, [&](std::size_t cell) { return volumes[cell] < (own.empty() ? least : own[cell]); }),
                "below MINPV in pore volume");
}

}  // namespace geomend::repair
