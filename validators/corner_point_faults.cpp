// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "validators/corner_point.h"
#include "validators/fault_sides.h"

// What fault records say against the throws that are there: C18, C20 and G03.

namespace geomend::validators {

namespace {

// Corners of a cell on its +I or +J side, and those of the next cell that they meet.
constexpr std::array<std::array<unsigned, 4>, 2> near_side{{{1, 3, 5, 7}, {2, 3, 6, 7}}};
constexpr std::array<std::array<unsigned, 4>, 2> far_side{{{0, 2, 4, 6}, {0, 1, 4, 5}}};

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

bool both_judged(const GridScope& scope, std::size_t cell, std::size_t axis) {
    const std::size_t next = neighbour(scope.grid(), scope.grid().ijk(cell), axis);
    return next < scope.grid().cell_count() && scope.judged(cell) && scope.judged(next);
}

bool without_throw(const GridScope& scope, std::size_t cell, std::size_t axis) {
    return both_judged(scope, cell, axis) && throw_at(scope, scope.grid().ijk(cell), axis) <= scope.depth_tolerance();
}

// What a stated fault is like between neighbours of one layer.
struct FaultThrow {
    std::uint64_t judged = 0, without = 0;
    bool is_idle() const { return judged > 0 && judged == without; }
};

FaultThrow throw_of(const GridScope& scope, const Fault& fault) {
    FaultThrow all;
    each_stated_side(scope.grid(), fault, [&](std::size_t cell, std::size_t axis) {
        if (!both_judged(scope, cell, axis)) return;
        ++all.judged;
        all.without += without_throw(scope, cell, axis) ? 1 : 0;
    });
    return all;
}

// Per cell bit 1 where its +I side is on a stated fault, bit 2 where its +J side is. \param idle also faults without any throw
std::vector<std::uint8_t> stated_sides(const GridScope& scope, bool idle) {
    const auto& grid = scope.grid();
    std::vector<std::uint8_t> stated(grid.cell_count(), 0);
    for (const Fault& fault : grid.faults) {
        if (!idle && throw_of(scope, fault).is_idle()) continue;
        each_stated_side(grid, fault, [&](std::size_t cell, std::size_t axis) { stated[cell] |= static_cast<std::uint8_t>(1u << axis); });
    }
    return stated;
}

// A fault that has throw elsewhere: where it has none. Of a fault without any G03 tells.
void find_stated_without_throw(const GridScope& scope, std::vector<Finding>& findings) {
    if (scope.grid().faults.empty()) return;
    const std::vector<std::uint8_t> stated = stated_sides(scope, false);
    std::uint64_t sides = 0;
    FoundCells found;
    for (std::size_t cell = 0; cell < stated.size(); ++cell) {
        unsigned here = 0;
        for (std::size_t axis = 0; axis < 2; ++axis) here += (stated[cell] >> axis & 1u) != 0 && without_throw(scope, cell, axis) ? 1 : 0;
        sides += here;
        if (here > 0) found.add(cell, here);
    }
    if (found.count == 0) return;
    Finding f = cells_finding(
        scope, "C18",
        "faults are stated at " + counted(sides, "side", "sides") + " of cells (+I or +J of those listed) where they have no throw", found);
    for (const Fault& fault : scope.grid().faults) {
        const FaultThrow all = throw_of(scope, fault);
        if (all.without > 0 && !all.is_idle() && f.entities.size() <= listed_elements) f.entities.push_back({"fault", fault.name});
    }
    f.measures = {{"sides", static_cast<double>(sides)}};
    findings.push_back(std::move(f));
}

void find_throw_without_fault(const GridScope& scope, std::vector<Finding>& findings) {
    const std::vector<std::uint8_t> stated = stated_sides(scope, true);
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
    find_stated_without_throw(scope, findings);
    find_throw_without_fault(scope, findings);
}

void check_idle_faults(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    std::vector<std::size_t> cells;
    std::vector<EntityRef> faults;
    std::uint64_t sides = 0;
    for (const Fault& fault : grid.faults) {
        const FaultThrow all = throw_of(scope, fault);
        if (!all.is_idle()) continue;
        sides += all.judged;
        faults.push_back({"fault", fault.name});
        each_stated_side(grid, fault, [&](std::size_t cell, std::size_t axis) {
            if (both_judged(scope, cell, axis)) cells.push_back(cell);
        });
    }
    if (faults.empty()) return;
    std::ranges::sort(cells);
    cells.erase(std::ranges::unique(cells).begin(), cells.end());
    FoundCells found;
    for (const std::size_t cell : cells) found.add(cell, 0);
    const bool one = faults.size() == 1;
    Finding f = cells_finding(scope, "G03",
                              counted(faults.size(), "fault displaces", "faults displace") + " nothing: '" + faults[0].name +
                                  (one ? "'" : "', ...") + ": at all " + counted(sides, "side", "sides") + " of cells where " +
                                  (one ? "it is" : "they are") + " stated (+I or +J of those listed) neighbours of one layer meet",
                              found);
    f.measures = {{"faults", static_cast<double>(faults.size())}, {"sides", static_cast<double>(sides)}};
    faults.resize(std::min(faults.size(), listed_elements));
    f.entities.insert(f.entities.end(), faults.begin(), faults.end());
    findings.push_back(std::move(f));
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
    std::string which;
    if (outside > 0)
        which = counted(outside, "reaches", "reach") + " outside the grid or " + (outside == 1 ? "runs" : "run") + " backwards";
    if (thick > 0) which += (which.empty() ? "" : ", ") + counted(thick, "is", "are") + " not on one face";
    f.message = counted(f.count, "fault record is", "fault records are") + " wrong: " + which + "; first cells of theirs are listed";
    f.measures = {{"outside", static_cast<double>(outside)}, {"not_on_one_face", static_cast<double>(thick)}};
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
