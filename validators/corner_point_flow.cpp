// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "grid/pore_volume.h"
#include "validators/corner_point.h"
#include "validators/touching_cells.h"

// What matters to flow: C16, C17 and C21.

namespace geomend::validators {

void check_pore_volumes(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    if (!grid::knows_pore_volumes(grid)) return;
    const std::vector<double> volumes = grid::pore_volumes(grid);
    const std::vector<double> own_least = grid::fitting_values(grid, "MINPVV", 0);
    const double least = grid::least_pore_volume(grid);
    const auto found = find_cells(scope, [&](std::size_t cell, std::uint32_t, std::uint32_t, std::uint32_t) {
        const double bound = own_least.empty() ? least : own_least[cell];
        return Judgement{grid.is_active(cell) && volumes[cell] < bound, bound - volumes[cell]};
    });
    if (found.count == 0) return;
    const std::string bound = !own_least.empty()       ? "its MINPVV"
                              : grid.least_pore_volume ? "MINPV, " + rounded(least)
                                                       : "1e-6, the usual MINPV";
    Finding f = cells_finding(scope, "C16",
                              "the pore volume of " + counted(found.count, "active cell", "active cells") + " is below " + bound +
                                  ": simulators make such cells inactive",
                              found);
    if (own_least.empty()) f.measures = {{"least_pore_volume", least}};
    findings.push_back(std::move(f));
}

void check_parts(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    if (!fits_in_32_bits(grid)) return;
    DisjointSets parts(grid.cell_count());
    each_touch(scope,
               [&](std::size_t a, std::size_t b, bool) { parts.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)); });
    const auto& present = scope.connections().present;
    std::vector<std::uint32_t> size(grid.cell_count(), 0);
    for (std::uint32_t cell = 0; cell < size.size(); ++cell) {
        if (present[cell] != 0) ++size[parts.root(cell)];
    }
    const auto largest = static_cast<std::uint32_t>(std::ranges::max_element(size) - size.begin());
    FoundCells found;
    std::uint64_t number = 0;
    for (std::uint32_t cell = 0; cell < size.size(); ++cell) {
        number += size[cell] > 0 ? 1 : 0;
        if (present[cell] != 0 && parts.root(cell) != largest) found.add(cell, 0);
    }
    if (number < 2) return;
    Finding f = cells_finding(scope, "C17",
                              "the active cells form " + std::to_string(number) +
                                  " parts that are not connected: " + counted(size[largest], "cell", "cells") + " in the largest, " +
                                  counted(found.count, "cell", "cells") + " elsewhere, as listed",
                              found);
    f.measures = {{"parts", static_cast<double>(number)}, {"largest_part", static_cast<double>(size[largest])}};
    findings.push_back(std::move(f));
}

std::vector<std::size_t> isolated_cells(const GridScope& scope) {
    const auto& grid = scope.grid();
    std::vector<std::size_t> cells;
    if (!fits_in_32_bits(grid)) return cells;
    std::vector<std::uint8_t> touched(grid.cell_count(), 0);
    each_touch(scope, [&](std::size_t a, std::size_t b, bool) { touched[a] = touched[b] = 1; });
    const auto& present = scope.connections().present;
    if (std::ranges::count_if(present, [](std::uint8_t p) { return p != 0; }) < 2) return cells;
    for (std::size_t cell = 0; cell < touched.size(); ++cell) {
        if (present[cell] != 0 && touched[cell] == 0) cells.push_back(cell);
    }
    return cells;
}

void check_isolated(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    if (!fits_in_32_bits(grid)) return;
    FoundCells found;
    for (const std::size_t cell : isolated_cells(scope)) found.add(cell, 0);
    if (found.count > 0) {
        findings.push_back(
            cells_finding(scope, "C21", counted(found.count, "active cell has", "active cells have") + " no active neighbour", found));
    }
    const std::size_t columns = std::size_t{grid.dims[0]} * grid.dims[1];
    std::vector<std::uint8_t> joined(columns, 0);
    each_touch(scope, [&](std::size_t a, std::size_t b, bool lateral) {
        if (lateral) joined[a % columns] = joined[b % columns] = 1;
    });
    std::vector<std::uint32_t> height(columns, 0);
    const auto& present = scope.connections().present;
    for (std::size_t cell = 0; cell < present.size(); ++cell) height[cell % columns] += present[cell] != 0 ? 1 : 0;
    if (std::ranges::count_if(height, [](std::uint32_t h) { return h > 0; }) < 2) return;  // one column has no others to touch
    Finding f = grid_finding(scope, "C21", {});
    f.element_kind = "column-ij";
    for (std::size_t c = 0; c < columns; ++c) {
        if (height[c] < 2 || joined[c] != 0) continue;  // a single cell was told above
        ++f.count;
        if (f.index.size() == listed_elements) continue;
        f.elements.push_back(static_cast<std::int64_t>(c % grid.dims[0]) + 1);
        f.elements.push_back(static_cast<std::int64_t>(c / grid.dims[0]) + 1);
        f.index.push_back(static_cast<std::int64_t>(c));
    }
    if (f.count == 0) return;
    f.message = counted(f.count, "column of active cells touches", "columns of active cells touch") + " no other column";
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
