// SPDX-License-Identifier: AGPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/codes.h"
#include "base/vectors.h"
#include "validators/corner_point.h"
#include "validators/unset_corners.h"

// What the arrays themselves say: C01, C02 and C15. Readers refuse most of it; grids made otherwise come here, too.

namespace geomend::validators {

namespace {

/// How often each number for "not set" stands at corners of some cells, and among the coordinates of their pillars.
struct UnsetCounts {
    std::map<std::string, std::uint64_t> depths, across;
    std::uint64_t corners = 0;
};

const double* pillar_of(const CornerPointGrid& grid, const std::array<std::uint32_t, 3>& ijk, unsigned c) {
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    const std::size_t set = grid.reservoirs.empty() ? 0 : pillar_count(grid.dims) * pillar_set(grid, ijk[2]);
    return grid.pillars.data() + 6 * (set + ijk[0] + (c & 1U) + lines * (std::size_t{ijk[1]} + ((c >> 1U) & 1U)));
}

void count_unset(const CornerPointGrid& grid, const UnsetValues& unset, std::size_t cell, UnsetCounts& counts) {
    const auto ijk = grid.ijk(cell);
    for (unsigned c = 0; c < 8; ++c) {
        const double depth = grid.depths[corner_index(grid.dims, ijk[0], ijk[1], ijk[2], c)];
        if (!unset.is_set_depth(depth)) {
            ++counts.depths[short_number(depth)];
            ++counts.corners;
        }
        if (c > 3) continue;
        const double* six = pillar_of(grid, ijk, c);
        for (std::size_t k = 0; k < 6; ++k) {
            if (UnsetValues::is_huge(six[k]) || (k % 3 != 2 && UnsetValues::holds(unset.across, six[k]))) {
                ++counts.across[short_number(six[k])];
            }
        }
    }
}

/// "ZCORN is -99999 at 4 corners, COORD is 1e+30 beside 1 cell".
std::string words_of(const UnsetCounts& counts) {
    constexpr std::size_t most = 4;
    std::string text;
    std::size_t told = 0;
    const auto add = [&](const std::string& what) {
        if (++told <= most) text += (text.empty() ? "" : ", ") + what;
    };
    for (const auto& [value, times] : counts.depths) add("a depth of " + value + " at " + counted(times, "corner", "corners"));
    for (const auto& [value, times] : counts.across)
        add(value + " in " + counted(times, "coordinate of pillars", "coordinates of pillars"));
    return told > most ? text + " and others" : text;
}

/// The middle of those corners of a cell that are set, as an elevation.
std::optional<Vec3> place_of_set_corners(const CornerPointGrid& grid, const UnsetValues& unset, std::size_t cell) {
    if (grid.cylindrical) return std::nullopt;
    const auto ijk = grid.ijk(cell);
    Vec3 sum{};
    double count = 0;
    for (unsigned c = 0; c < 8; ++c) {
        const double depth = grid.depths[corner_index(grid.dims, ijk[0], ijk[1], ijk[2], c)];
        const double* six = pillar_of(grid, ijk, c);
        if (!unset.is_set_depth(depth) || !unset.is_set_pillar(six)) continue;
        sum = plus(sum, pillar_point(six, depth));
        ++count;
    }
    if (count == 0) return std::nullopt;
    return Vec3{sum[0] / count, sum[1] / count, 0.0 - sum[2] / count};
}

}  // namespace

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
    const UnsetValues unset = unset_values(grid, scope.all_cells());
    UnsetCounts counts;
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
        if (scope.in_scope(cell) && !scope.judged(cell)) count_unset(grid, unset, cell, counts);
    }
    Finding f = cells_finding(
        scope, "C02",
        counted(found.count, "cell has", "cells have") +
            " a corner or a pillar that is not set (not finite, 1e20 or more, or a number for no value): " + words_of(counts) +
            "; the first is " + cell_text(grid, found.first.front()) + "; no other check judges " + (found.count == 1 ? "it" : "them"),
        found);
    for (const std::size_t cell : found.first) {
        if (const auto place = place_of_set_corners(grid, unset, cell)) f.points.push_back(*place);
    }
    f.measures = {{"corners", static_cast<double>(counts.corners)}};
    findings.push_back(std::move(f));
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
