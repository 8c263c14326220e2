// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/cell_findings.h"

#include <cstdio>

#include "base/codes.h"

namespace geomend::validators {

std::string cell_text(const CornerPointGrid& grid, std::size_t cell) {
    const auto [i, j, k] = grid.ijk(cell);
    return "(" + std::to_string(i + 1) + "," + std::to_string(j + 1) + "," + std::to_string(k + 1) + ")";
}

Finding grid_finding(const GridScope& scope, std::string_view code, std::string message) {
    Finding f = make_finding(code, std::move(message), {}, 0);
    f.entities = {{"corner-point-grid", scope.grid().info.name}};
    return f;
}

void list_cells(const CornerPointGrid& grid, const FoundCells& cells, Finding& finding) {
    finding.count = cells.count;
    finding.element_kind = "cell-ijk";
    for (const std::size_t cell : cells.first) {
        for (const std::uint32_t n : grid.ijk(cell)) finding.elements.push_back(std::int64_t{n} + 1);
        finding.index.push_back(static_cast<std::int64_t>(cell));
    }
}

Finding cells_finding(const GridScope& scope, std::string_view code, std::string message, const FoundCells& cells) {
    Finding f = grid_finding(scope, code, std::move(message));
    list_cells(scope.grid(), cells, f);
    return f;
}

}  // namespace geomend::validators
