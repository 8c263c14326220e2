// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/grid_connections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "grid/edits.h"
#include "grid/pore_volume.h"
#include "grid/transmissibility.h"

namespace geomend {

namespace {

// Attributes TRANX, TRANY, TRANZ.
void set_attribute(CornerPointGrid& grid, const char* name, std::vector<double> values) {
    std::erase_if(grid.info.attributes, [&](const Attribute& a) { return a.name == name && a.location == AttributeLocation::cell; });
    Attribute a;
    a.name = name;
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    grid.info.attributes.push_back(std::move(a));
}

void add_connection(CornerPointGrid& grid, std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t>& known, std::uint64_t a,
                    std::uint64_t b, std::optional<double> value) {
    const auto [at, fresh] = known.try_emplace(std::minmax(a, b), grid.connections.size());
    if (fresh) {
        grid.connections.push_back({a, b, value});
    } else if (value) {
        auto& stated = grid.connections[at->second].transmissibility;
        stated = stated.value_or(0) + *value;
    }
}

// What section EDIT says of transmissibilities of neighbours: operations on the computed ones, then those that are stated.
// Simulators (flow 2022.10) change none of pairs that are joined past cells between them.
void apply_section_edit(const CornerPointGrid& grid, const grid::Connections& found, bool from_deck, grid::Transmissibilities& values) {
    constexpr std::array names = {"TRANX", "TRANY", "TRANZ"};
    constexpr std::array bits = {grid::Connections::east, grid::Connections::south, grid::Connections::below};
    const std::array arrays = {&values.x, &values.y, &values.z};
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    const auto touches_below = [&](std::size_t cell) { return cell + layer < found.present.size() && found.present[cell + layer] != 0; };
    for (std::size_t d = 0; d < 3; ++d) {
        std::vector<double>& array = *arrays[d];
        const auto joined = [&](std::size_t cell) {
            return d == 2 ? array[cell] != 0 && touches_below(cell) : array[cell] != 0 || (found.neighbours[cell] & bits[d]) != 0;
        };
        grid::apply_edits(grid, names[d], joined, array);
        if (!from_deck) continue;
        const std::vector<double> stated = grid::fitting_values(grid, names[d], NAN);
        for (std::size_t cell = 0; cell < stated.size(); ++cell) {
            if (!std::isnan(stated[cell]) && joined(cell)) array[cell] = stated[cell];
        }
    }
}

// Stated connections of cells that the geometry joins anyway: simulators add them to its transmissibilities, and list none.
void add_to_neighbours(CornerPointGrid& grid, const grid::Connections& found, grid::Transmissibilities& values) {
    std::erase_if(grid.connections, [&](const CornerPointGrid::Connection& c) {
        const auto low = static_cast<std::size_t>(std::min(c.first, c.second)),
                   high = static_cast<std::size_t>(std::max(c.first, c.second));
        if (!c.transmissibility || high >= grid.cell_count()) return false;
        const unsigned to = found.neighbours[low];
        double* value = nullptr;
        if ((to & grid::Connections::east) != 0 && high == low + 1) value = &values.x[low];
        else if ((to & grid::Connections::south) != 0 && high == low + grid.dims[0]) value = &values.y[low];
        else if ((to & grid::Connections::below) != 0 && high == grid::next_below(grid, found.present, low)) value = &values.z[low];
        if (value == nullptr) return false;
        *value += *c.transmissibility;
        return true;
    });
}

// Factors of EDITNNC, which are in the transmissibilities then.
void apply_factors(CornerPointGrid& grid) {
    std::map<std::pair<std::uint64_t, std::uint64_t>, double> factors;
    for (const auto& factor : grid.connection_factors)
        factors.try_emplace(std::minmax(factor.first, factor.second), 1.0).first->second *= factor.value;
    for (auto& c : grid.connections) {
        const auto factor = factors.find(std::minmax(c.first, c.second));
        if (c.transmissibility && factor != factors.end()) *c.transmissibility *= factor->second;
    }
    grid.connection_factors.clear();
}

// Cells that simulators leave out for their pore volume.
void tell_left_out(const CornerPointGrid& grid, const grid::SimulatedCells& cells, std::vector<Finding>& findings) {
    const std::size_t count = cells.without_pores.size() + cells.below_minpv.size();
    if (count == 0) return;
    Finding told = make_finding("F153", {}, {}, count);
    told.element_kind = "cell";
    for (const auto* list : {&cells.without_pores, &cells.below_minpv}) {
        for (std::size_t n = 0; n < list->size() && told.index.size() < 100; ++n)
            told.index.push_back(static_cast<std::int64_t>((*list)[n]));
    }
    const auto [i, j, k] = grid.ijk(static_cast<std::size_t>(told.index.front()));
    told.message = std::to_string(cells.without_pores.size()) + " active cells without pore volume and " +
                   std::to_string(cells.below_minpv.size()) + " below MINPV take no part, as in simulators (the first is (" +
                   std::to_string(i + 1) + "," + std::to_string(j + 1) + "," + std::to_string(k + 1) + ")); " +
                   std::to_string(cells.bridges.size()) + " pairs are joined past them";
    told.entities.push_back({"grid", grid.info.name, -1});
    findings.push_back(std::move(told));
}

}  // namespace

Result<void> compute_connections(CornerPointGrid& grid, bool from_deck, std::vector<Finding>& findings) {
    constexpr double negligible = 1e-6;
    grid::SimulatedCells cells = grid::simulated_cells(grid);
    tell_left_out(grid, cells, findings);
    const grid::Connections found = grid::connections(grid, std::move(cells));
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> known;
    for (std::size_t c = 0; c < grid.connections.size(); ++c)
        known.try_emplace(std::minmax(grid.connections[c].first, grid.connections[c].second), c);
    const bool permeable = find_attribute(grid.info.attributes, "PERMX", AttributeLocation::cell) != nullptr;
    if (!permeable) {
        for (const auto& pair : found.others) add_connection(grid, known, pair.first, pair.second, std::nullopt);
        return {};
    }
    auto values = grid::transmissibilities(grid, found);
    if (!values) return std::move(values).why();
    std::uint64_t left_out = 0;
    for (std::size_t c = 0; c < found.others.size(); ++c) {
        if (values->others[c] < negligible) ++left_out;
        else add_connection(grid, known, found.others[c].first, found.others[c].second, values->others[c]);
    }
    apply_section_edit(grid, found, from_deck, *values);
    if (from_deck) add_to_neighbours(grid, found, *values);
    apply_factors(grid);
    set_attribute(grid, "TRANX", std::move(values->x));
    set_attribute(grid, "TRANY", std::move(values->y));
    set_attribute(grid, "TRANZ", std::move(values->z));
    if (left_out == 0) return {};
    Finding told =
        make_finding("F151",
                     std::to_string(left_out) + " of " + std::to_string(found.others.size()) +
                         " pairs of cells that touch across layers have a transmissibility below 1e-6: no connection is listed for them",
                     {}, left_out);
    told.entities.push_back({"grid", grid.info.name, -1});
    findings.push_back(std::move(told));
    return {};
}

}  // namespace geomend
