// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <set>

#include "grid/fault_boxes.h"
#include "validators/corner_point.h"
#include "validators/fault_sides.h"

// What fault records say that comes to nothing, or is said by others, too: C25 and C26.

namespace geomend::validators {

namespace {

// Which columns have an active cell.
std::vector<std::uint8_t> active_columns(const CornerPointGrid& grid) {
    const std::size_t columns = std::size_t{grid.dims[0]} * grid.dims[1];
    std::vector<std::uint8_t> active(columns, 0);
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
        if (grid.is_active(cell)) active[cell % columns] = 1;
    }
    return active;
}

// Beyond a side: the cell, or the number of cells at the border of the grid.
std::size_t beyond(const CornerPointGrid& grid, std::size_t cell, CellFace face) {
    auto at = grid.ijk(cell);
    const std::size_t axis = axis_of(face);
    if (is_plus(face) ? at[axis] + 1 >= grid.dims[axis] : at[axis] == 0) return grid.cell_count();
    at[axis] = is_plus(face) ? at[axis] + 1 : at[axis] - 1;
    return grid.cell(at[0], at[1], at[2]);
}

// Whether flow can pass a side: across a throw the cell beyond may be any one of its column.
bool has_cells_on_both_sides(const CornerPointGrid& grid, const std::vector<std::uint8_t>& columns, std::size_t cell, CellFace face) {
    const std::size_t other = beyond(grid, cell, face);
    if (other == grid.cell_count()) return false;
    if (axis_of(face) == 2) return grid.is_active(cell) && grid.is_active(other);
    return (grid.is_active(cell) && columns[other % columns.size()] != 0) || (grid.is_active(other) && columns[cell % columns.size()] != 0);
}

// Whether a fault has active cells on both sides anywhere, or a record of which C20 tells.
bool has_effect(const CornerPointGrid& grid, const std::vector<std::uint8_t>& columns, const Fault& fault) {
    bool any = false;
    for (const Fault::Box& box : fault.boxes) {
        if (!inside(grid, box) || !flat(box)) return true;
        grid::each_cell(grid, box, [&](std::size_t cell) { any = any || has_cells_on_both_sides(grid, columns, cell, box.face); });
        if (any) return true;
    }
    return false;
}

// One finding about faults that are stated for nothing.
void tell_idle(const GridScope& scope, const std::vector<const Fault*>& faults, bool multiplied, std::vector<Finding>& findings) {
    if (faults.empty()) return;
    std::vector<std::size_t> cells;
    std::uint64_t without_record = 0;
    for (const Fault* fault : faults) {
        without_record += fault->boxes.empty() ? 1 : 0;
        for (const Fault::Box& box : fault->boxes) grid::each_cell(scope.grid(), box, [&](std::size_t cell) { cells.push_back(cell); });
    }
    std::ranges::sort(cells);
    cells.erase(std::ranges::unique(cells).begin(), cells.end());
    FoundCells found;
    for (const std::size_t cell : cells) found.add(cell, 0);
    std::string message = counted(faults.size(), "fault lies", "faults lie") + " between no active cells: '" + faults[0]->name +
                          (faults.size() > 1 ? "', ..." : "'");
    if (without_record > 0)
        message += faults.size() > 1 ? "; " + std::to_string(without_record) + " of them without any FAULTS record here"
                                     : "; it has no FAULTS record here";
    if (multiplied) message += faults.size() > 1 ? "; their multipliers have no effect" : "; its multiplier has no effect";
    Finding f = cells_finding(scope, "C25", std::move(message), found);
    if (multiplied) use_other_severity(f);
    f.count = std::max<std::uint64_t>(1, found.count);
    for (const Fault* fault : faults) {
        if (f.entities.size() <= listed_elements) f.entities.push_back({"fault", fault->name});
    }
    f.measures = {{"faults", static_cast<double>(faults.size())}};
    findings.push_back(std::move(f));
}

}  // namespace

void check_fault_effects(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    if (grid.faults.empty()) return;
    const std::vector<std::uint8_t> columns = active_columns(grid);
    std::vector<const Fault*> plain, multiplied;
    for (const Fault& fault : grid.faults) {
        if (has_effect(grid, columns, fault)) continue;
        (fault.multiplier && *fault.multiplier != 1 ? multiplied : plain).push_back(&fault);
    }
    tell_idle(scope, multiplied, true, findings);
    tell_idle(scope, plain, false, findings);
}

void check_shared_fault_faces(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    using Face = std::pair<std::uint64_t, std::uint32_t>;  // 3 cell + axis of the + side, fault
    std::vector<Face> faces;
    for (std::uint32_t n = 0; n < grid.faults.size(); ++n) {
        for (const Fault::Box& box : grid.faults[n].boxes) {
            grid::each_cell(grid, box, [&](std::size_t cell) {
                const std::size_t upper = is_plus(box.face) ? cell : beyond(grid, cell, box.face);
                if (upper < grid.cell_count()) faces.emplace_back(3 * std::uint64_t{upper} + axis_of(box.face), n);
            });
        }
    }
    std::ranges::sort(faces);
    faces.erase(std::ranges::unique(faces).begin(), faces.end());
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    std::set<std::uint32_t> named;
    FoundCells cells;
    std::uint64_t sides = 0;
    std::size_t last = grid.cell_count();
    for (std::size_t i = 0, j; i < faces.size(); i = j) {
        for (j = i + 1; j < faces.size() && faces[j].first == faces[i].first;) ++j;
        if (j - i < 2) continue;
        ++sides;
        const auto cell = static_cast<std::size_t>(faces[i].first / 3);
        if (cell != last) cells.add(cell, 0);
        last = cell;
        for (std::size_t k = i; k < j; ++k) named.insert(faces[k].second);
        for (std::size_t k = i + 1; k < j; ++k) pairs.emplace(faces[i].second, faces[k].second);
    }
    if (sides == 0) return;
    const auto& [a, b] = *pairs.begin();
    Finding f = cells_finding(scope, "C26",
                              counted(sides, "side", "sides") + " of cells (+I, +J or +K of those listed) " + (sides == 1 ? "is" : "are") +
                                  " stated in more than one fault, such as '" + grid.faults[a].name + "' and '" + grid.faults[b].name +
                                  "': multipliers of both act there",
                              cells);
    for (const std::uint32_t n : named) {
        if (f.entities.size() <= listed_elements) f.entities.push_back({"fault", grid.faults[n].name});
    }
    f.measures = {{"sides", static_cast<double>(sides)}};
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
