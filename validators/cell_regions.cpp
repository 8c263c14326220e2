// SPDX-License-Identifier: AGPL-3.0-or-later
// Regions of a mesh of cells: each is to be one volume.
#include "validators/cell_regions.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>

#include "base/disjoint_sets.h"
#include "base/wording.h"

namespace geomend::validators {

namespace {

/// Which region each volume cell is in, and what the regions are called.
struct CellRegions {
    std::vector<std::int64_t> of;  ///< per cell of the mesh; no_region where it is in none
    bool stated = false;           ///< entities of the file, or an array that is called after regions; else materials and the like
    std::string array;             ///< name of the array; empty: entities
};
constexpr std::int64_t no_region = std::numeric_limits<std::int64_t>::min();

/// "Region_ID" as "regionid".
std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return plain;
}

/// The array of whole numbers that says in which region cells are; nullptr where none is called so.
const Attribute* region_array(const CellMesh& mesh) {
    constexpr std::array<std::string_view, 9> names = {"region",        "regions",     "regionid",   "regionids", "attribute",
                                                       "cellentityids", "materialids", "materialid", "material"};
    for (const std::string_view wanted : names) {
        for (const Attribute& a : mesh.info.attributes) {
            const bool whole = !std::holds_alternative<std::vector<double>>(a.values) &&
                               !std::holds_alternative<std::vector<float>>(a.values) &&
                               !std::holds_alternative<std::vector<std::string>>(a.values);
            if (whole && a.location == AttributeLocation::cell && a.components == 1 && value_count(a) == mesh.cell_count() &&
                plain_name(a.name) == wanted)
                return &a;
        }
    }
    return nullptr;
}

CellRegions regions_of(const CellScope& scope) {
    const CellMesh& mesh = scope.mesh();
    CellRegions regions;
    const bool has_entities = std::ranges::any_of(mesh.entities, [](const CellMesh::Entity& e) { return e.dimension == 3; });
    if (has_entities && mesh.cell_entity.size() == mesh.cell_count()) {
        regions.stated = true;
        regions.of.assign(mesh.cell_count(), no_region);
        for (const std::uint32_t cell : scope.volume_cells()) {
            if (mesh.cell_entity[cell] != no_index) regions.of[cell] = mesh.cell_entity[cell];
        }
        return regions;
    }
    const Attribute* a = region_array(mesh);
    if (a == nullptr) return regions;
    regions.array = a->name;
    regions.stated = plain_name(a->name).starts_with("region");
    regions.of.assign(mesh.cell_count(), no_region);
    for (const std::uint32_t cell : scope.volume_cells()) {
        const double value = value_as_double(*a, cell);
        if (!is_no_data(*a, value)) regions.of[cell] = static_cast<std::int64_t>(value);
    }
    return regions;
}

}  // namespace

std::vector<std::int64_t> stated_regions_of_cells(const CellScope& scope) {
    CellRegions regions = regions_of(scope);
    if (!regions.stated) regions.of.clear();
    return std::move(regions.of);
}

void check_cell_regions(const CellScope& scope, std::span<const std::array<std::uint32_t, 2>> facing, std::vector<Finding>& findings) {
    const CellRegions regions = regions_of(scope);
    if (regions.of.empty()) return;
    DisjointSets parts(scope.mesh().cell_count());
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (regions.of[a] == regions.of[b]) parts.join(a, b);
    };
    const auto cell_of = [&](std::uint32_t face) { return scope.faces()[face].cell; };
    const auto groups = scope.group_first();
    std::vector<std::uint32_t> cells;
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        cells.clear();
        for (std::uint32_t k = groups[g]; k < groups[g + 1]; ++k) cells.push_back(cell_of(scope.grouped()[k]));
        if (cells.size() > 2) std::ranges::sort(cells, {}, [&](std::uint32_t cell) { return regions.of[cell]; });
        for (std::size_t k = 1; k < cells.size(); ++k) join(cells[k - 1], cells[k]);
    }
    for (const auto& [a, b] : facing) join(a, b);
    std::map<std::int64_t, std::map<std::uint32_t, std::uint64_t>> sizes;  // of the parts of each region
    for (const std::uint32_t cell : scope.volume_cells()) {
        if (regions.of[cell] != no_region) ++sizes[regions.of[cell]][parts.root(cell)];
    }
    std::erase_if(sizes, [](const auto& region) { return region.second.size() < 2; });
    std::map<std::int64_t, std::uint32_t> largest;
    for (const auto& [region, of_parts] : sizes)
        largest[region] = std::ranges::max_element(of_parts, {}, [](const auto& p) { return p.second; })->first;
    std::map<std::int64_t, std::vector<std::uint32_t>> apart;  // cells that are not in the largest part
    for (const std::uint32_t cell : scope.volume_cells()) {
        const auto at = largest.empty() ? largest.end() : largest.find(regions.of[cell]);
        if (at != largest.end() && parts.root(cell) != at->second) apart[at->first].push_back(cell);
    }
    for (const auto& [region, of_region] : apart) {
        std::string name = std::to_string(region);
        if (regions.array.empty()) {
            const CellMesh::Entity& e = scope.mesh().entities[static_cast<std::size_t>(region)];
            name = e.name.empty() ? std::to_string(e.tag) : e.name;
        }
        Finding finding =
            cells_of_mesh_finding(scope, "M37",
                                  "region '" + name + "'" + (regions.array.empty() ? "" : " of '" + regions.array + "'") + in_mesh(scope) +
                                      " is in " + std::to_string(sizes[region].size()) + " parts that no face joins; " +
                                      counted(of_region.size(), "cell is", "cells are") + " not in the largest",
                                  of_region);
        finding.entities.push_back({"region", name});
        if (!regions.stated) use_other_severity(finding);
        finding.measures = {{"parts", static_cast<double>(sizes[region].size())}};
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
