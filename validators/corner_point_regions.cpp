// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "base/disjoint_sets.h"
#include "base/number_text.h"
#include "validators/corner_point.h"
#include "validators/touching_cells.h"

// What region numbers say against the cells that bear them: C23 and C24.

namespace geomend::validators {

namespace {

// Regions that are places. Those of rock (SATNUM, ROCKNUM, IMBNUM, OPERNUM) are kinds, which may lie anywhere.
constexpr std::array place_arrays = {"EQLNUM", "PVTNUM", "FLUXNUM", "MULTNUM"};
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

/// The cells of one array, by the parts in which those of one number hang together.
struct RegionParts {
    const Attribute* regions = nullptr;
    std::vector<double> number;        ///< per cell, or no_region
    std::vector<std::uint32_t> part;   ///< per cell: the first cell of its part
    std::vector<std::uint32_t> first;  ///< the first cells of all parts of present cells with a number; they ascend
    bool scattered = false;            ///< a number has several parts
};

RegionParts parts_of(const GridScope& scope, const Attribute& regions) {
    const auto& grid = scope.grid();
    const auto& present = scope.connections().present;
    RegionParts parts;
    parts.regions = &regions;
    parts.number.resize(grid.cell_count());
    for (std::size_t cell = 0; cell < parts.number.size(); ++cell) {
        const double value = value_as_double(regions, cell);
        parts.number[cell] = std::isfinite(value) && !is_no_data(regions, value) ? value : no_region;
    }
    DisjointSets joined(grid.cell_count());
    const auto join_alike = [&](std::size_t a, std::size_t b) {
        if (parts.number[a] == parts.number[b]) joined.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    };
    each_touch(scope, [&](std::size_t a, std::size_t b, bool) { join_alike(a, b); });
    each_side_by_side(grid, present, join_alike);
    parts.part = std::move(joined).roots();
    std::set<double> numbers;
    for (std::uint32_t cell = 0; cell < parts.part.size(); ++cell) {  // only present cells are joined
        if (present[cell] == 0 || parts.part[cell] != cell || parts.number[cell] == no_region) continue;
        parts.first.push_back(cell);
        parts.scattered = !numbers.insert(parts.number[cell]).second || parts.scattered;
    }
    return parts;
}

std::vector<std::uint32_t> parts_of_grid(const GridScope& scope) {
    DisjointSets joined(scope.grid().cell_count());
    each_touch(scope,
               [&](std::size_t a, std::size_t b, bool) { joined.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)); });
    return std::move(joined).roots();
}

/// "3 into 2, 7 into 4"
std::string list_regions(const std::map<double, std::uint32_t>& parts_of_region) {
    std::string list;
    for (const auto& [region, parts] : parts_of_region) {
        if (!list.empty()) list += ", ";
        if (list.size() > 100) return list + "...";
        list += number_text(region) + " into " + std::to_string(parts);
    }
    return list;
}

void tell_scattered(const GridScope& scope, const RegionParts& parts, const std::vector<std::uint32_t>& part_of_grid,
                    std::vector<Finding>& findings) {
    std::vector<std::uint32_t> size(parts.part.size(), 0);
    for (const std::uint32_t part : parts.part) ++size[part];
    // What lies in different parts of the grid (C17) cannot hang together: each such part is a place of its own.
    std::map<std::pair<double, std::uint32_t>, std::vector<std::uint32_t>> places;
    for (const std::uint32_t cell : parts.first) places[{parts.number[cell], part_of_grid[cell]}].push_back(cell);
    std::vector<std::uint8_t> astray(parts.part.size(), 0);  // at the first cells of parts
    std::map<double, std::uint32_t> parts_of_region;
    std::set<double> regions;
    for (const auto& [place, firsts] : places) {
        regions.insert(place.first);
        if (firsts.size() < 2) continue;
        parts_of_region[place.first] += static_cast<std::uint32_t>(firsts.size());
        for (const std::uint32_t cell : firsts) astray[cell] = 1;
        astray[*std::ranges::max_element(firsts, {}, [&](std::uint32_t cell) { return size[cell]; })] = 0;
    }
    FoundCells found;
    for (std::size_t cell = 0; cell < parts.part.size(); ++cell) {
        if (astray[parts.part[cell]] != 0) found.add(cell, 0);
    }
    if (found.count == 0) return;
    const std::string& name = parts.regions->name;
    Finding f = cells_finding(scope, "C23",
                              std::to_string(parts_of_region.size()) + " of " + counted(regions.size(), "region", "regions") + " of " +
                                  name + (parts_of_region.size() == 1 ? " falls" : " fall") +
                                  " into parts that are not connected (region " + list_regions(parts_of_region) +
                                  "): " + counted(found.count, "cell", "cells") + " outside of the largest parts, as listed",
                              found);
    for (const auto& [region, count] : parts_of_region) {
        if (f.entities.size() <= listed_elements) f.entities.push_back({"region", region_name(name, region)});
    }
    f.measures = {{"regions", static_cast<double>(parts_of_region.size())}};
    findings.push_back(std::move(f));
}

}  // namespace

void check_scattered_regions(const GridScope& scope, std::vector<Finding>& findings) {
    const auto& grid = scope.grid();
    if (!fits_in_32_bits(grid)) return;
    std::vector<const Attribute*> arrays;
    for (const Attribute& a : grid.info.attributes) {
        const bool is_place = is_one_of(place_arrays, a.name) || is_in_place(a.name) || a.name == scope.asked_regions();
        if (is_of_cells(grid, a) && is_place) arrays.push_back(&a);
    }
    if (arrays.empty()) return;
    scope.connections();  // before threads ask for them
    std::vector<RegionParts> parts(arrays.size());
    parallel_for_each_index(arrays.size(), [&](std::size_t n) {
        if (scope.stopped()) return;
        RegionParts of_array = parts_of(scope, *arrays[n]);
        if (of_array.scattered) parts[n] = std::move(of_array);
    });
    if (std::ranges::none_of(parts, &RegionParts::scattered)) return;
    const std::vector<std::uint32_t> part_of_grid = parts_of_grid(scope);
    for (const RegionParts& of_array : parts) {
        if (of_array.scattered) tell_scattered(scope, of_array, part_of_grid, findings);
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
