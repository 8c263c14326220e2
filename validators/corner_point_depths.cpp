// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/corner_point.h"

#include <algorithm>
#include <cmath>

// What the depths of corners on one pillar say: C03 to C06.

namespace geomend::validators {

namespace {

// The next judged cell below in a column, or the number of cells.
std::size_t judged_below(const GridScope& scope, std::size_t cell) {
    const std::size_t layer = std::size_t{scope.grid().dims[0]} * scope.grid().dims[1], cells = scope.grid().cell_count();
    std::size_t next = cell + layer;
    while (next < cells && !scope.judged(next)) next += layer;
    return std::min(next, cells);
}

// Calls body(distance) on each pillar on which both cells are upright: from the bottom of the upper one to the top of
// the lower one, negative where they overlap. Where a cell is inverted C03 tells, and what follows from it is not told.
template <class Body>
void each_distance(const GridScope& scope, std::size_t upper, std::size_t lower, const Body& body) {
    const auto u = scope.grid().ijk(upper), l = scope.grid().ijk(lower);
    if (!scope.grid().reservoirs.empty() && pillar_set(scope.grid(), u[2]) != pillar_set(scope.grid(), l[2])) return;
    const double least = -scope.depth_tolerance();
    for (unsigned c = 0; c < 4; ++c) {
        const double above = scope.depth(u[0], u[1], u[2], c), bottom = scope.depth(u[0], u[1], u[2], c + 4);
        const double top = scope.depth(l[0], l[1], l[2], c), below = scope.depth(l[0], l[1], l[2], c + 4);
        if (bottom - above >= least && below - top >= least) body(top - bottom);
    }
}

unsigned collapsed_pillars(const GridScope& scope, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    unsigned count = 0;
    for (unsigned c = 0; c < 4; ++c) {
        count += std::abs(scope.depth(i, j, k, c + 4) - scope.depth(i, j, k, c)) <= scope.depth_tolerance() ? 1 : 0;
    }
    return count;
}

}  // namespace

void check_inverted(const GridScope& scope, std::vector<Finding>& findings) {
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        Judgement of;
        unsigned pillars = 0;
        for (unsigned c = 0; c < 4; ++c) {
            const double above = scope.depth(i, j, k, c) - scope.depth(i, j, k, c + 4);
            if (above <= scope.depth_tolerance()) continue;
            ++pillars;
            of.measure = std::max(of.measure, above);
        }
        of.found = pillars > 0;
        of.kind = pillars == 4 ? 1 : 0;
        return of;
    });
    if (found.count == 0) return;
    Finding f = cells_finding(scope, "C03",
                              counted(found.count, "cell has", "cells have") + " the bottom above the top on one or more pillars (" +
                                  std::to_string(found.by_kind[1]) + " inverted on all four, " + std::to_string(found.by_kind[0]) +
                                  " twisted), at most by " + rounded(found.worst) + " in " + cell_text(scope.grid(), found.worst_cell),
                              found);
    f.measures = {{"largest_inversion", found.worst},
                  {"inverted", static_cast<double>(found.by_kind[1])},
                  {"twisted", static_cast<double>(found.by_kind[0])}};
    findings.push_back(std::move(f));
}

void check_vertical_neighbours(const GridScope& scope, std::vector<Finding>& findings) {
    const auto overlaps = find_cells(scope, [&](std::size_t cell, std::uint32_t, std::uint32_t, std::uint32_t) {
        Judgement of;
        const std::size_t below = judged_below(scope, cell);
        if (below == scope.grid().cell_count()) return of;
        each_distance(scope, cell, below, [&](double distance) { of.measure = std::max(of.measure, -distance); });
        of.found = of.measure > scope.depth_tolerance();
        return of;
    });
    // A gap is one only between direct neighbours: else inactive cells fill it.
    const std::size_t layer = std::size_t{scope.grid().dims[0]} * scope.grid().dims[1];
    const auto gaps = find_cells(scope, [&](std::size_t cell, std::uint32_t, std::uint32_t, std::uint32_t) {
        Judgement of;
        const std::size_t below = cell + layer;
        if (below >= scope.grid().cell_count() || !scope.judged(below)) return of;
        each_distance(scope, cell, below, [&](double distance) { of.measure = std::max(of.measure, distance); });
        of.found = of.measure > scope.depth_tolerance();
        return of;
    });
    if (overlaps.count > 0) {
        Finding f = cells_finding(scope, "C04",
                                  counted(overlaps.count, "cell reaches", "cells reach") + " into the next active one below, at most by " +
                                      rounded(overlaps.worst) + " under " + cell_text(scope.grid(), overlaps.worst_cell),
                                  overlaps);
        f.measures = {{"overlap", overlaps.worst}};
        findings.push_back(std::move(f));
    }
    if (gaps.count > 0) {
        Finding f = cells_finding(scope, "C04",
                                  counted(gaps.count, "cell leaves", "cells leave") + " a gap above the one below, at most of " +
                                      rounded(gaps.worst) + " under " + cell_text(scope.grid(), gaps.worst_cell),
                                  gaps);
        use_other_severity(f);
        f.measures = {{"gap", gaps.worst}};
        findings.push_back(std::move(f));
    }
}

void check_collapsed(const GridScope& scope, std::vector<Finding>& findings) {
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return Judgement{collapsed_pillars(scope, i, j, k) == 4};
    });
    if (found.count == 0) return;
    findings.push_back(cells_finding(scope, "C05",
                                     counted(found.count, "active cell has", "active cells have") + " no thickness: simulators drop " +
                                         (found.count == 1 ? "it" : "them"),
                                     found));
}

void check_wedges(const GridScope& scope, std::vector<Finding>& findings) {
    const auto found = find_cells(scope, [&](std::size_t, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const unsigned pillars = collapsed_pillars(scope, i, j, k);
        return Judgement{pillars > 0 && pillars < 4, 0, pillars % 4};
    });
    if (found.count == 0) return;
    Finding f = cells_finding(
        scope, "C06",
        counted(found.count, "cell is a wedge: it has", "cells are wedges: they have") + " no thickness on one to three pillars", found);
    f.measures = {{"on_one_pillar", static_cast<double>(found.by_kind[1])},
                  {"on_two_pillars", static_cast<double>(found.by_kind[2])},
                  {"on_three_pillars", static_cast<double>(found.by_kind[3])}};
    findings.push_back(std::move(f));
}

}  // namespace geomend::validators
