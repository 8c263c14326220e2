// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "base/disjoint_sets.h"
#include "base/number_text.h"
#include "validators/corner_point.h"
#include "validators/touching_cells.h"

// What region numbers say against the cells that bear them: C23 and C24.

namespace geomend::validators {

namespace {

// Regions that are places. Those of rock (SATNUM, ROCKNUM, IMBNUM, OPERNUM) are kinds, which may lie anywhere.
constexpr std::array places = {"EQLNUM", "PVTNUM", "FLUXNUM", "MULTNUM"};
// Regions that simulators number from 1.
constexpr std::array numbered = {"SATNUM", "PVTNUM", "EQLNUM", "ROCKNUM", "IMBNUM"};

bool is_one_of(std::span<const char* const> names, std::string_view name) {
    return std::ranges::any_of(names, [&](const char* n) { return name == n; });
}
// FIPNUM, and the further sets of such regions, FIP with up to five letters of one's own.
bool is_in_place(std::string_view name) { return name.starts_with("FIP") && name.size() <= 8; }

bool is_of_cells(const CornerPointGrid& grid, const Attribute& a) {
    return a.location == AttributeLocation::cell && a.components == 1 && value_count(a) == grid.cell_count();
}

std::string region_name(const std::string& array, double number) { return array + "_" + number_text(number); }

constexpr double no_region = -std::numeric_limits<double>::infinity();

/// A region within one part of the grid.
struct Place {
    std::uint32_t parts = 0, largest = 0, cells_of_largest = 0;
};

// Calls body(a, b) for present cells that are neighbours by (i,j,k) in one layer, whatever the throw between them: a fault does
// not tear a region.
template <class Body>
void each_side_by_side(const CornerPointGrid& grid, const std::vector<std::uint8_t>& present, const Body& body) {
    for (std::size_t cell = 0; cell < present.size(); ++cell) {
        if (present[cell] == 0) continue;
        const auto [i, j, k] = grid.ijk(cell);
        if (i + 1 < grid.dims[0] && present[cell + 1] != 0) body(cell, cell + 1);
        if (j + 1 < grid.dims[1] && present[cell + grid.dims[0]] != 0) body(cell, cell + grid.dims[0]);
    }
}

void find_scattered(const GridScope& scope, const Attribute& regions, const std::vector<std::uint32_t>& part_of_grid,
                    std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    const auto& present = scope.connections().present;
    std::vector<double> number(grid.cell_count());
    for (std::size_t cell = 0; cell < number.size(); ++cell) {
        const double value = value_as_double(regions, cell);
        number[cell] = std::isfinite(value) && !is_no_data(regions, value) ? value : no_region;
    }
    DisjointSets joined(grid.cell_count());
    const auto join_alike = [&](std::size_t a, std::size_t b) {
        if (number[a] == number[b]) joined.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    };
    each_touch(scope, [&](std::size_t a, std::size_t b, bool) { join_alike(a, b); });
    each_side_by_side(grid, present, join_alike);
    const std::vector<std::uint32_t> part = std::move(joined).roots();
    std::vector<std::uint32_t> size(part.size(), 0);
    for (std::size_t cell = 0; cell < part.size(); ++cell) size[part[cell]] += present[cell] != 0 ? 1 : 0;
    // What lies in different parts of the grid (C17) cannot hang together.
    std::map<std::pair<double, std::uint32_t>, Place> all;
    for (std::uint32_t cell = 0; cell < part.size(); ++cell) {
        if (size[cell] == 0 || part[cell] != cell || number[cell] == no_region) continue;
        Place& place = all[{number[cell], part_of_grid[cell]}];
        ++place.parts;
        if (size[cell] > place.cells_of_largest) {
            place.largest = cell;
            place.cells_of_largest = size[cell];
        }
    }
    std::vector<std::uint8_t> at_home(part.size(), 0);  // per part, at its first cell
    for (const auto& [key, place] : all) at_home[place.largest] = 1;
    FoundCells found;
    for (std::uint32_t cell = 0; cell < part.size(); ++cell) {
        if (present[cell] != 0 && number[cell] != no_region && at_home[part[cell]] == 0) found.add(cell, 0);
    }
    if (found.count == 0) return;
    std::map<double, std::uint32_t> parts_of_region;
    std::uint64_t regions_in_all = 0;
    for (auto place = all.begin(); place != all.end(); ++place) {
        if (place == all.begin() || std::prev(place)->first.first != place->first.first) ++regions_in_all;
        if (place->second.parts > 1) parts_of_region[place->first.first] += place->second.parts;
    }
    std::string which;
    for (const auto& [region, parts] : parts_of_region) {
        if (!which.empty()) which += ", ";
        if (which.size() > 100) {
            which += "...";
            break;
        }
        which += number_text(region) + " into " + std::to_string(parts);
    }
    Finding f = cells_finding(scope, "C23",
                              std::to_string(parts_of_region.size()) + " of " + counted(regions_in_all, "region", "regions") + " of " +
                                  regions.name + (parts_of_region.size() == 1 ? " falls" : " fall") +
                                  " into parts that are no neighbours (region " + which + "): " + counted(found.count, "cell", "cells") +
                                  " outside of the largest parts, which are listed",
                              found);
    for (const auto& [region, parts] : parts_of_region) {
        if (f.entities.size() <= listed_elements) f.entities.push_back({"region", region_name(regions.name, region)});
    }
    f.measures = {{"regions", static_cast<double>(parts_of_region.size())}};
    findings.push_back(std::move(f));
}

}  // namespace

void check_scattered_regions(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    if (!fits_in_32_bits(grid)) return;
    std::vector<std::uint32_t> part_of_grid;
    for (const Attribute& a : grid.info.attributes) {
        const bool is_place = is_one_of(places, a.name) || is_in_place(a.name) || a.name == scope.asked_regions();
        if (!is_of_cells(grid, a) || !is_place || scope.stopped()) continue;
        if (part_of_grid.empty()) {
            DisjointSets joined(grid.cell_count());
            each_touch(scope, [&](std::size_t c, std::size_t d, bool) {
                joined.join(static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(d));
            });
            part_of_grid = std::move(joined).roots();
        }
        find_scattered(scope, a, part_of_grid, findings);
    }
}

void check_region_numbers(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    for (const Attribute& a : grid.info.attributes) {
        if (!is_of_cells(grid, a) || !(is_one_of(numbered, a.name) || is_in_place(a.name))) continue;
        FoundCells found;
        for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
            const double number = value_as_double(a, cell);
            if (grid.is_active(cell) && !is_no_data(a, number) && number < 1) found.add(cell, -number);
        }
        if (found.count == 0) continue;
        Finding f =
            cells_finding(scope, "C24",
                          a.name + " is below 1 in " + counted(found.count, "active cell", "active cells") + ", " +
                              number_text(-found.worst) + " in " + cell_text(grid, found.worst_cell) + ": regions are numbered from 1",
                          found);
        f.entities.push_back({"attribute", a.name});
        findings.push_back(std::move(f));
    }
}

}  // namespace geomend::validators
