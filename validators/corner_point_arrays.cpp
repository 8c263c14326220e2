// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "base/codes.h"
#include "validators/corner_point.h"

// What the arrays themselves say: C01, C02 and C15. Readers refuse most of it; grids made otherwise come here, too.

namespace geomend::validators {

void check_array_lengths(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    const auto wrong = [&](std::string message) {
        Finding f = make_finding("C01", std::move(message), {}, 0);
        f.entities = {{"corner-point-grid", grid.info.name}};
        findings.push_back(std::move(f));
    };
    if (std::string what = has_geometry(grid) ? misfit(grid) : std::string(); !what.empty()) return wrong(std::move(what));
    std::string unfit;
    for (const Attribute& a : grid.info.attributes) {
        const std::size_t expected = a.components * grid.cell_count();
        if (a.location != AttributeLocation::cell || value_count(a) == expected) continue;
        unfit += (unfit.empty() ? "" : "; ") + a.name + ": expected " + std::to_string(expected) + " values, found " +
                 std::to_string(value_count(a));
    }
    if (!unfit.empty()) wrong(std::move(unfit));
}

void check_coordinates(const GridScope& scope, std::vector<Finding>& findings) {
    const CornerPointGrid& grid = scope.grid();
    FoundCells found;
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
        if (scope.in_scope(cell) && !scope.judged(cell)) found.add(cell, 0);
    }
    if (found.count == 0) return;
    findings.push_back(cells_finding(scope, "C02",
                                     counted(found.count, "cell has", "cells have") +
                                         " a corner or a pillar that is not finite, or as large as 1e20; no other check judges " +
                                         (found.count == 1 ? "it" : "them"),
                                     found));
}

void check_activity(const GridScope& scope, std::vector<Finding>& findings) {
    const CornerPointGrid& grid = scope.grid();
    const bool single = grid.porosity == CornerPointGrid::Porosity::single;
    FoundCells found;
    for (std::size_t cell = 0; cell < grid.activity.size(); ++cell) {
        const unsigned value = grid.activity[cell];
        if (value > (single ? 1u : 3u)) found.add(cell, value);
    }
    if (found.count == 0) return;
    Finding f = cells_finding(scope, "C15",
                              "ACTNUM of " + counted(found.count, "cell is", "cells is") + (single ? " neither 0 nor 1" : " not 0 to 3") +
                                  ", at most " + rounded(found.worst) + " in " + cell_text(grid, found.worst_cell),
                              found);
    f.measures = {{"largest", found.worst}};
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
