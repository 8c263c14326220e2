// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "base/wording.h"
#include "validators/grid_scope.h"

namespace geomend::validators {

/// Most elements that one finding lists.
inline constexpr std::size_t listed_elements = 100;

/// What a check says of one cell.
struct Judgement {
    bool found = false;
    double measure = 0;  ///< how bad; the largest one is told
    unsigned kind = 0;   ///< 0 to 3: cells are also counted by kind
};

/// The cells that a check found: all are counted, the first ones are listed, the worst is known.
struct FoundCells {
    std::uint64_t count = 0;
    std::array<std::uint64_t, 4> by_kind{};
    std::vector<std::size_t> first;
    double worst = 0;
    std::size_t worst_cell = 0;

    void add(std::size_t cell, double measure, unsigned kind = 0) {
        if (count == 0 || measure > worst) {
            worst = measure;
            worst_cell = cell;
        }
        ++count;
        ++by_kind[kind];
        if (first.size() < listed_elements) first.push_back(cell);
    }
    /// Takes in what was found behind this.
    void append(const FoundCells& next) {
        if (next.count == 0) return;
        if (count == 0 || next.worst > worst) {
            worst = next.worst;
            worst_cell = next.worst_cell;
        }
        count += next.count;
        for (std::size_t k = 0; k < by_kind.size(); ++k) by_kind[k] += next.by_kind[k];
        const std::size_t room = std::min(next.first.size(), listed_elements - first.size());
        first.insert(first.end(), next.first.begin(), next.first.begin() + static_cast<std::ptrdiff_t>(room));
    }
};

/// Asks judge(cell, i, j, k) -> Judgement of each judged cell, in parallel; the result does not depend on threads.
template <class Judge>
FoundCells find_cells(const GridScope& scope, const Judge& judge) {
    constexpr std::size_t block = 8192;
    const std::size_t cells = scope.grid().cell_count();
    std::vector<FoundCells> parts((cells + block - 1) / block);
    parallel_for_each_index(parts.size(), [&](std::size_t b) {
        if (scope.stopped()) return;
        for (std::size_t cell = b * block, last = std::min(cells, (b + 1) * block); cell < last; ++cell) {
            if (!scope.judged(cell)) continue;
            const auto [i, j, k] = scope.grid().ijk(cell);
            const Judgement j_of_cell = judge(cell, i, j, k);
            if (j_of_cell.found) parts[b].add(cell, j_of_cell.measure, j_of_cell.kind);
        }
    });
    FoundCells all;
    for (const FoundCells& part : parts) all.append(part);
    return all;
}

/// "(3,4,1)", counting from 1.
std::string cell_text(const CornerPointGrid& grid, std::size_t cell);

/// A finding of the catalogue's severity about a grid.
Finding grid_finding(const GridScope& scope, std::string_view code, std::string message);
/// Lists cells in it: (i,j,k) from 1 one after the other (kind "cell-ijk"), and our indices.
void list_cells(const CornerPointGrid& grid, const FoundCells& cells, Finding& finding);
/// The two together.
Finding cells_finding(const GridScope& scope, std::string_view code, std::string message, const FoundCells& cells);

}  // namespace geomend::validators
