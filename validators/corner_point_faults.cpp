// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "validators/corner_point.h"

// What fault records say against the throws that are there: C18 and C20.

namespace geomend::validators {

namespace {

using Fault = CornerPointGrid::Fault;

constexpr std::size_t axis_of(CellFace face) { return static_cast<std::size_t>(face) / 2; }
constexpr bool is_plus(CellFace face) { return (static_cast<unsigned>(face) & 1u) != 0; }

bool inside(const CornerPointGrid& grid, const Fault::Box& box) {
    for (std::size_t a = 0; a < 3; ++a) {
        if (box.first[a] > box.last[a] || box.last[a] >= grid.dims[a]) return false;
    }
    return true;
}

bool flat(const Fault::Box& box) { return box.first[axis_of(box.face)] == box.last[axis_of(box.face)]; }

// Corners of a cell on its +I or +J side, and those of the next cell that they meet.
constexpr std::array<std::array<unsigned, 4>, 2> near_side{{{1, 3, 5, 7}, {2, 3, 6, 7}}};
constexpr std::array<std::array<unsigned, 4>, 2> far_side{{{0, 2, 4, 6}, {0, 1, 4, 5}}};

// The neighbour of a cell along I (axis 0) or J (axis 1), or the number of cells.
std::size_t neighbour(const CornerPointGrid& grid, const std::array<std::uint32_t, 3>& at, std::size_t axis) {
    if (at[axis] + 1 >= grid.dims[axis]) return grid.cell_count();
    return grid.cell(at[0] + (axis == 0 ? 1 : 0), at[1] + (axis == 1 ? 1 : 0), at[2]);
}

// Largest difference in depth across the +I or +J side of a cell.
double throw_at(const GridScope& scope, const std::array<std::uint32_t, 3>& at, std::size_t axis) {
    double most = 0;
    for (std::size_t n = 0; n < 4; ++n) {
        const double here = scope.depth(at[0], at[1], at[2], near_side[axis][n]);
        const double there = scope.depth(at[0] + (axis == 0 ? 1 : 0), at[1] + (axis == 1 ? 1 : 0), at[2], far_side[axis][n]);
        most = std::max(most, std::abs(here - there));
    }
    return most;
}

// Calls body(cell, axis) for each +I (axis 0) and +J (axis 1) side that a record is for. Sides on the border of the grid
// and tops and bottoms have no throw and are left out.
template <class Body>
void each_stated_side(const CornerPointGrid& grid, const Fault& fault, const Body& body) {
    for (const Fault::Box& box : fault.boxes) {
        const std::size_t axis = axis_of(box.face);
        if (axis == 2 || !inside(grid, box) || !flat(box)) continue;
        auto first = box.first, last = box.last;
        if (!is_plus(box.face)) {  // the same side is the + side of the cell before
            if (first[axis] == 0) continue;
            --first[axis];
            --last[axis];
        }
        for (std::uint32_t k = first[2]; k <= last[2]; ++k) {
            for (std::uint32_t j = first[1]; j <= last[1]; ++j) {
                for (std::uint32_t i = first[0]; i <= last[0]; ++i) {
                    if (neighbour(grid, {i, j, k}, axis) < grid.cell_count()) body(grid.cell(i, j, k), axis);
                }
            }
        }
    }
}

// Per cell bit 1 where its +I side is on a stated fault, bit 2 where its +J side is.
std::vector<std::uint8_t> stated_sides(const CornerPointGrid& grid) {
    std::vector<std::uint8_t> stated(grid.cell_count(), 0);
    for (const Fault& fault : grid.faults)
        each_stated_side(grid, fault, [&](std::size_t cell, std::size_t axis) { stated[cell] |= static_cast<std::uint8_t>(1u << axis); });
    return stated;
}

bool both_judged(const GridScope& scope, std::size_t cell, std::size_t axis) {
    const std::size_t next = neighbour(scope.grid(), scope.grid().ijk(cell), axis);
    return next < scope.grid().cell_count() && scope.judged(cell) && scope.judged(next);
}

void find_stated_without_throw(const GridScope& scope, const std::vector<std::uint8_t>& stated, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    const auto without = [&](std::size_t cell, std::size_t axis) {
        return both_judged(scope, cell, axis) && throw_at(scope, grid.ijk(cell), axis) <= scope.depth_tolerance();
    };
    std::uint64_t sides = 0;
    FoundCells found;
    for (std::size_t cell = 0; cell < stated.size(); ++cell) {
        unsigned here = 0;
        for (std::size_t axis = 0; axis < 2; ++axis) here += (stated[cell] >> axis & 1u) != 0 && without(cell, axis) ? 1 : 0;
        sides += here;
        if (here > 0) found.add(cell, here);
    }
    if (found.count == 0) return;
    Finding f = cells_finding(
        scope, "C18",
        "faults are stated at " + counted(sides, "side", "sides") + " of cells (+I or +J of those listed) where there is no throw", found);
    for (const Fault& fault : grid.faults) {
        bool any = false;
        each_stated_side(grid, fault, [&](std::size_t cell, std::size_t axis) { any = any || without(cell, axis); });
        if (any && f.entities.size() <= listed_elements) f.entities.push_back({"fault", fault.name});
    }
    f.measures = {{"sides", static_cast<double>(sides)}};
    findings.push_back(std::move(f));
}

void find_throw_without_fault(const GridScope& scope, const std::vector<std::uint8_t>& stated, std::vector<Finding>& findings) {
    const auto found = find_cells(scope, [&](std::size_t cell, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        Judgement of;
        unsigned sides = 0;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            if ((stated[cell] >> axis & 1u) != 0 || !both_judged(scope, cell, axis)) continue;
            const double by = throw_at(scope, {i, j, k}, axis);
            if (by <= scope.depth_tolerance()) continue;
            ++sides;
            of.measure = std::max(of.measure, by);
        }
        of.found = sides > 0;
        of.kind = sides;
        return of;
    });
    if (found.count == 0) return;
    const std::uint64_t sides = found.by_kind[1] + 2 * found.by_kind[2];
    Finding f = cells_finding(scope, "C18",
                              "there is throw at " + counted(sides, "side", "sides") + " of cells (+I or +J of those listed), at most " +
                                  rounded(found.worst) + " at " + cell_text(scope.grid(), found.worst_cell) + ", where no fault is stated",
                              found);
    f.measures = {{"sides", static_cast<double>(sides)}, {"largest_throw", found.worst}};
    findings.push_back(std::move(f));
}

}  // namespace

void check_fault_throws(const GridScope& scope, std::vector<Finding>& findings) {
    const std::vector<std::uint8_t> stated = stated_sides(scope.grid());
    find_stated_without_throw(scope, stated, findings);
    find_throw_without_fault(scope, stated, findings);
}

void check_fault_boxes(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    Finding f = grid_finding(scope, "C20", {});
    f.element_kind = "cell-ijk";
    std::uint64_t outside = 0, thick = 0;
    for (const Fault& fault : grid.faults) {
        bool named = false;
        for (const Fault::Box& box : fault.boxes) {
            const bool is_inside = inside(grid, box);
            if (is_inside && flat(box)) continue;
            ++(is_inside ? thick : outside);
            if (!named && f.entities.size() <= listed_elements) f.entities.push_back({"fault", fault.name});
            named = true;
            if (f.elements.size() >= 3 * listed_elements) continue;
            for (const std::uint32_t n : box.first) f.elements.push_back(std::int64_t{n} + 1);
        }
    }
    f.count = outside + thick;
    if (f.count == 0) return;
    f.message = counted(f.count, "fault record is", "fault records are") + " wrong: " + std::to_string(outside) +
                " reach outside the grid or run backwards, " + std::to_string(thick) +
                " are not on one face; first cells of theirs are listed";
    f.measures = {{"outside", static_cast<double>(outside)}, {"not_on_one_face", static_cast<double>(thick)}};
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
