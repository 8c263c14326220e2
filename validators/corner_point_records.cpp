// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "validators/cell_findings.h"
#include "validators/corner_point.h"
#include "validators/object_places.h"
#include "validators/registry.h"

// Records that no grid can follow: stated connections (C29), local grids in one place (C30), angles of radial grids (C31).

namespace geomend::validators {

namespace {

std::string connection_text(const CornerPointGrid& grid, const CornerPointGrid::Connection& c) {
    const std::size_t cells = grid.cell_count();
    return cell_text(grid, c.first % cells) + " - " + cell_text(grid, c.second % cells);
}

/// Whether a cell, of the fracture where its number is beyond those of the matrix, is active.
bool takes_part(const CornerPointGrid& grid, std::uint64_t cell) {
    if (grid.activity.empty()) return true;
    const bool dual = grid.porosity != CornerPointGrid::Porosity::single;
    const bool fracture = cell >= grid.cell_count();
    const std::uint8_t state = grid.activity[cell % grid.cell_count()];
    return dual ? (state & (fracture ? 2U : 1U)) != 0 : state != 0;
}

void tell_connections(const GridScope& scope, const std::vector<const CornerPointGrid::Connection*>& wrong, const std::string& one,
                      const std::string& many, bool is_no_error, std::vector<Finding>& findings) {
    if (wrong.empty()) return;
    const CornerPointGrid& grid = scope.grid();
    FoundCells cells;
    std::vector<std::size_t> numbers;
    for (const auto* c : wrong) numbers.push_back(c->first % grid.cell_count());
    std::ranges::sort(numbers);
    numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
    for (const std::size_t cell : numbers) cells.add(cell, 0);
    Finding f = cells_finding(scope, "C29",
                              counted(wrong.size(), "stated connection", "stated connections") + ' ' + (wrong.size() == 1 ? one : many) +
                                  ": " + connection_text(grid, *wrong.front()) + (wrong.size() > 1 ? ", ..." : ""),
                              cells);
    if (is_no_error) use_other_severity(f);
    f.count = wrong.size();
    findings.push_back(std::move(f));
}

/// Whether two cells are side by side in the numbering, along one axis.
bool are_side_by_side(const CornerPointGrid& grid, const CornerPointGrid::Connection& c) {
    if (std::max(c.first, c.second) >= grid.cell_count()) return false;
    const auto a = grid.ijk(static_cast<std::size_t>(c.first)), b = grid.ijk(static_cast<std::size_t>(c.second));
    unsigned steps = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) steps += a[axis] > b[axis] ? a[axis] - b[axis] : b[axis] - a[axis];
    return steps == 1;
}

/// Whether faces of two such cells touch, so that simulators join them without any record.
bool do_touch(const GridScope& scope, const CornerPointGrid::Connection& c) {
    const grid::Connections& all = scope.connections();
    const auto low = static_cast<std::size_t>(std::min(c.first, c.second)), high = static_cast<std::size_t>(std::max(c.first, c.second));
    const unsigned to = all.neighbours[low];
    return ((to & grid::Connections::east) != 0 && high == low + 1) ||
           ((to & grid::Connections::south) != 0 && high == low + scope.grid().dims[0]) ||
           ((to & grid::Connections::below) != 0 && high == grid::next_below(scope.grid(), all.present, low));
}

/// Host cells of a local grid, ascending: those that its cells name, else its box.
std::vector<std::uint64_t> host_cells(const CornerPointGrid& host, const CornerPointGrid& local) {
    std::vector<std::uint64_t> cells = local.host->cells;
    if (cells.empty()) {
        for (std::uint32_t k = local.host->first[2]; k <= std::min(local.host->last[2], host.dims[2] - 1); ++k) {
            for (std::uint32_t j = local.host->first[1]; j <= std::min(local.host->last[1], host.dims[1] - 1); ++j) {
                for (std::uint32_t i = local.host->first[0]; i <= std::min(local.host->last[0], host.dims[0] - 1); ++i)
                    cells.push_back(host.cell(i, j, k));
            }
        }
    }
    std::ranges::sort(cells);
    cells.erase(std::ranges::unique(cells).begin(), cells.end());
    std::erase_if(cells, [&](std::uint64_t cell) { return cell >= host.cell_count(); });
    return cells;
}

}  // namespace

void check_stated_connections(const GridScope& scope, std::vector<Finding>& findings) {
    const CornerPointGrid& grid = scope.grid();
    std::vector<const CornerPointGrid::Connection*> self, negative, inactive, neighbours;
    const bool is_single = grid.porosity == CornerPointGrid::Porosity::single && has_geometry(grid);
    for (const auto& c : grid.connections) {
        if (c.first == c.second) self.push_back(&c);
        else if (!takes_part(grid, c.first) || !takes_part(grid, c.second)) inactive.push_back(&c);
        else if (is_single && are_side_by_side(grid, c) && do_touch(scope, c)) neighbours.push_back(&c);
        if (c.transmissibility && *c.transmissibility < 0) negative.push_back(&c);
    }
    tell_connections(scope, self, "joins a cell with itself", "join a cell with itself", false, findings);
    tell_connections(scope, negative, "has a transmissibility below 0", "have a transmissibility below 0", false, findings);
    tell_connections(scope, inactive, "leads to an inactive cell: nothing flows there", "lead to inactive cells: nothing flows there", true,
                     findings);
    tell_connections(scope, neighbours, "joins cells whose faces touch: simulators add it to what the geometry gives",
                     "join cells whose faces touch: simulators add them to what the geometry gives", true, findings);
}

void check_radial_angles(const GridScope& scope, std::vector<Finding>& findings) {
    const CornerPointGrid& grid = scope.grid();
    if (!grid.cylindrical || grid.pillars.empty()) return;
    const std::size_t lines = std::size_t{grid.dims[0]} + 1;
    const auto angle = [&](std::size_t i, std::size_t j) { return grid.pillars[6 * (i + lines * j) + 1]; };
    double most = 0;
    for (std::size_t i = 0; i < lines; ++i) most = std::max(most, std::abs(angle(i, grid.dims[1]) - angle(i, 0)));
    if (most <= 360 * (1 + 1e-6)) return;
    Finding f = grid_finding(scope, "C31", "the cells around the axis cover " + number_text(most) + " degrees together: more than 360");
    f.measures = {{"degrees", most}};
    f.points.push_back({0, 0, grid.pillars[2]});  // the axis, where the first pillar begins
    findings.push_back(std::move(f));
}

void check_local_grids(std::span<const CornerPointGrid* const> grids, std::vector<Finding>& findings) {
    for (const CornerPointGrid* host : grids) {
        std::vector<std::uint32_t> owner;  // of each cell the number of the local grid, from 1
        std::vector<const CornerPointGrid*> locals;
        for (const CornerPointGrid* local : grids) {
            if (!local->host || local == host) continue;
            if (local->host->grid.empty() ? host->host.has_value() : local->host->grid != host->info.name) continue;
            locals.push_back(local);
            owner.resize(host->cell_count(), 0);
            FoundCells shared;
            const CornerPointGrid* other = nullptr;
            for (const std::uint64_t cell : host_cells(*host, *local)) {
                if (owner[cell] != 0 && other == nullptr) other = locals[owner[cell] - 1];
                if (owner[cell] != 0) shared.add(static_cast<std::size_t>(cell), 0);
                else owner[cell] = static_cast<std::uint32_t>(locals.size());
            }
            if (other == nullptr) continue;
            Finding f = make_finding("C30",
                                     "local grids '" + other->info.name + "' and '" + local->info.name + "' refine the same " +
                                         (shared.count == 1 ? "cell, " : counted(shared.count, "cell", "cells") + ", the first is ") +
                                         cell_text(*host, shared.first.front()),
                                     {}, shared.count);
            f.entities = {{"corner-point-grid", other->info.name}, {"corner-point-grid", local->info.name}};
            list_cells(*host, shared, f);
            place_cells(*host, f);
            findings.push_back(std::move(f));
        }
    }
}

}  // namespace geomend::validators
