// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "validators/cell_findings.h"
#include "validators/object_places.h"
#include "validators/readiness.h"

// What a black-oil simulator needs of a corner-point grid beside sound cells.

namespace geomend::validators {

namespace {

Finding about(const CornerPointGrid& grid, std::string_view code, std::string message) {
    Finding f = target_finding(code, std::move(message));
    f.entities = {{"corner-point-grid", grid.info.name}};
    return f;
}

const Attribute* cell_attribute(const CornerPointGrid& grid, const char* name) {
    const Attribute* a = find_attribute(grid.info.attributes, name, AttributeLocation::cell);
    return a != nullptr && value_count(*a) == grid.cell_count() * a->components ? a : nullptr;
}

// Values that active cells cannot have: missing ones, and those out of range.
struct BadValues {
    FoundCells missing, outside;
};

BadValues bad_values(const CornerPointGrid& grid, const Attribute& a, double least, double most) {
    BadValues bad;
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
        if (!grid.is_active(cell)) continue;
        const double value = value_as_double(a, cell * a.components);
        if (!std::isfinite(value) || is_no_data(a, value)) bad.missing.add(cell, 0);
        else if (value < least || value > most) bad.outside.add(cell, std::abs(value));
    }
    return bad;
}

struct Property {
    const char* name;
    double least, most;
};
constexpr double unbounded = std::numeric_limits<double>::max();
constexpr std::array properties = {
    Property{"PORO", 0, 1},           Property{"PORV", 0, unbounded},   Property{"NTG", 0, 1},           Property{"PERMX", 0, unbounded},
    Property{"PERMY", 0, unbounded},  Property{"PERMZ", 0, unbounded},  Property{"MULTX", 0, unbounded}, Property{"MULTX-", 0, unbounded},
    Property{"MULTY", 0, unbounded},  Property{"MULTY-", 0, unbounded}, Property{"MULTZ", 0, unbounded}, Property{"MULTZ-", 0, unbounded},
    Property{"MULTPV", 0, unbounded}, Property{"TRANX", 0, unbounded},  Property{"TRANY", 0, unbounded}, Property{"TRANZ", 0, unbounded}};
/// What must have a value in each active cell. Of all others some cells may be without: 1 or what follows from the rest stands there.
constexpr std::array<std::string_view, 4> everywhere = {"PORO", "PERMX", "PERMY", "PERMZ"};

void check_values(const CornerPointGrid& grid, const Property& p, std::vector<Finding>& findings) {
    const Attribute* a = cell_attribute(grid, p.name);
    if (a == nullptr) return;
    const BadValues bad = bad_values(grid, *a, p.least, p.most);
    const std::string name = p.name;
    if (bad.missing.count > 0 && std::ranges::find(everywhere, name) != everywhere.end()) {
        Finding f = about(grid, "S04", name + " has no value in " + counted(bad.missing.count, "active cell", "active cells"));
        list_cells(grid, bad.missing, f);
        place_cells(grid, f);
        findings.push_back(std::move(f));
    }
    if (bad.outside.count > 0) {
        Finding f = about(grid, "S05",
                          name + " is " + (p.most == 1 ? "below 0 or above 1" : "below 0") + " in " +
                              counted(bad.outside.count, "active cell", "active cells"));
        list_cells(grid, bad.outside, f);
        place_cells(grid, f);
        findings.push_back(std::move(f));
    }
}

void check_properties(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    const auto has = [&](const char* name) { return cell_attribute(grid, name) != nullptr; };
    if (!has("PORO") && !has("PORV")) findings.push_back(about(grid, "S04", "there is neither PORO nor PORV: OPM Flow stops"));
    if (!has("PERMX")) findings.push_back(about(grid, "S04", "there is no PERMX: OPM Flow stops"));
    for (const char* name : {"PERMY", "PERMZ"}) {
        if (has("PERMX") && !has(name))
            findings.push_back(about(grid, "S12", std::string("there is no ") + name + ": PERMX is used instead"));
    }
    for (const Property& p : properties) check_values(grid, p, findings);
}

void check_faults(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    constexpr std::size_t longest = 8;
    Finding undeclared = about(grid, "S09", ""), long_names = about(grid, "S06", "");
    std::uint64_t unknown = 0, too_long = 0;
    std::map<std::string, std::string> by_front;
    std::string alike;
    for (const auto& fault : grid.faults) {
        if (fault.boxes.empty() && (fault.multiplier || fault.edit_multiplier)) {
            if (unknown++ == 0)
                undeclared.message = "MULTFLT names the fault '" + fault.name + "', which no record of FAULTS states: OPM Flow stops";
            if (undeclared.entities.size() <= listed_elements) undeclared.entities.push_back({"fault", fault.name});
        }
        const auto [at, is_new] = by_front.try_emplace(fault.name.substr(0, longest), fault.name);
        if (!is_new && alike.empty()) alike = "; '" + at->second + "' and '" + fault.name + "' begin with the same eight letters";
        if (fault.name.size() <= longest) continue;
        if (too_long++ == 0) long_names.message = "the name '" + fault.name + "' of a fault has more than eight letters";
        if (long_names.entities.size() <= listed_elements) long_names.entities.push_back({"fault", fault.name});
    }
    undeclared.count = unknown;
    long_names.count = too_long;
    long_names.message += alike;
    if (unknown > 0) findings.push_back(std::move(undeclared));
    if (too_long > 0) findings.push_back(std::move(long_names));
}

/// Multipliers of faults, of pairs of regions and of stated connections below 0 make conductances negative, as those of cells do.
void check_negative_factors(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    const auto tell = [&](const std::string& what) { findings.push_back(about(grid, "S05", what + ": conductances become negative")); };
    for (const auto& fault : grid.faults) {
        for (const auto& multiplier : {fault.multiplier, fault.edit_multiplier}) {
            if (multiplier && *multiplier < 0) tell("MULTFLT multiplies fault " + quoted(fault.name) + " by " + rounded(*multiplier));
        }
    }
    for (const auto& m : grid.region_multipliers) {
        if (m.value < 0) return tell("MULTREGT multiplies connections of regions by " + rounded(m.value));
    }
    for (const auto& f : grid.connection_factors) {
        if (f.value < 0) return tell("a connection of two cells is multiplied by " + rounded(f.value) + " (EDITNNC)");
    }
}

void check_map_unit(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    constexpr std::array<std::string_view, 3> known = {"METRES", "FEET", "CM"};
    if (!grid.map_axes || grid.map_unit.empty() || std::ranges::find(known, grid.map_unit) != known.end()) return;
    findings.push_back(about(grid, "S09", "MAPUNITS has the unit '" + grid.map_unit + "': OPM Flow stops"));
}

void check_region_multipliers(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    for (const auto& m : grid.region_multipliers) {
        const char* numbers = m.regions == 'F' ? "FLUXNUM" : m.regions == 'O' ? "OPERNUM" : "MULTNUM";
        // Where MULTNUM is not there all cells are of region 1.
        if (m.regions == 'M' || cell_attribute(grid, numbers) != nullptr) continue;
        findings.push_back(about(grid, "S09", std::string("MULTREGT uses ") + numbers + ", which is missing: OPM Flow stops"));
        break;
    }
    for (const auto& m : grid.region_multipliers) {
        if (!m.from || !m.to || *m.from != *m.to) continue;
        return findings.push_back(
            about(grid, "S09", "MULTREGT has a multiplier within region " + std::to_string(*m.from) + ": OPM Flow stops"));
    }
    for (const auto& m : grid.region_multipliers) {
        if ((m.connections != "NNC" && m.connections != "NONNC") || m.value == 1) continue;
        return findings.push_back(
            about(grid, "S09",
                  "MULTREGT multiplies " +
                      std::string(m.connections == "NNC" ? "connections of cells that are no neighbours by (i,j,k) (NNC)"
                                                         : "connections of neighbours by (i,j,k) only (NONNC)") +
                      ": OPM Flow 2022.10 takes vertical connections, and those across faults, for the other kind in "
                      "most grids, and multiplies others than stated"));
    }
}

/// Flow 2022.10 takes all factors of a pair of NNC but for the last pair in the order of cells, of which it takes the first.
void check_connection_factors(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    if (grid.connections.empty()) return;
    std::pair<std::uint64_t, std::uint64_t> last{0, 0};
    for (const auto& c : grid.connections) last = std::max(last, std::pair(std::min(c.first, c.second), std::max(c.first, c.second)));
    const auto is_last = [&](const auto& f) { return last == std::pair(std::min(f.first, f.second), std::max(f.first, f.second)); };
    if (std::ranges::count_if(grid.connection_factors, is_last) < 2) return;
    findings.push_back(about(grid, "S09",
                             "EDITNNC multiplies the connection of cells " + cell_text(grid, static_cast<std::size_t>(last.first)) +
                                 " and " + cell_text(grid, static_cast<std::size_t>(last.second)) +
                                 " more than once: OPM Flow 2022.10 takes the first of these factors only, as it is the last pair of NNC"));
}

}  // namespace

void check_grid_for_flow(const CornerPointGrid& grid, std::vector<Finding>& findings) {
    if (grid.host)
        return findings.push_back(about(grid, "S12",
                                        "this grid refines " + (grid.host->grid.empty() ? "the main grid" : "'" + grid.host->grid + "'") +
                                            ": OPM Flow ignores local grid refinements, and runs the cells of their hosts"));
    if (grid.porosity != CornerPointGrid::Porosity::single)
        findings.push_back(about(grid, "S09", "the grid has dual porosity, which OPM Flow does not support"));
    if (!misfit(grid).empty()) return;
    if (active_count(grid) == 0) return findings.push_back(about(grid, "S03", "no cell is active: there is nothing to simulate"));
    check_properties(grid, findings);
    check_faults(grid, findings);
    check_region_multipliers(grid, findings);
    check_connection_factors(grid, findings);
    check_negative_factors(grid, findings);
    check_map_unit(grid, findings);
    if (grid.unit_system.empty())
        findings.push_back(about(grid, "S12", "no unit system is stated: METRIC is assumed (metres, millidarcy, bar)"));
}

}  // namespace geomend::validators
