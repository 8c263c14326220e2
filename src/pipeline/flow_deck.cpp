// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/flow_deck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "base/number_text.h"
#include "base/text_cursor.h"
#include "base/wording.h"
#include "formats/grdecl/keywords.h"
#include "grid/cell_geometry.h"
#include "pipeline/grid_connections.h"

namespace geomend {

namespace {

/// What is needed of the grid.
struct GridFacts {
    double top = 1e300, base = -1e300;                        ///< depths of active cells, metres
    std::vector<std::array<std::uint32_t, 2>> whole_columns;  ///< columns all of whose cells are active, from 0
    std::uint64_t fault_boxes = 0;
    double volume = 0;         ///< of active cells, cubic metres
    double narrowest = 1e300;  ///< the least edge along I or J of the cells that wells may be in
};

GridFacts facts_of(const CornerPointGrid& grid) {
    GridFacts facts;
    const bool feet = grid.info.crs.axis_units[2] == "ft" || grid.info.crs.axis_units[2] == "FEET";
    const double metres = feet ? 0.3048 : 1;
    for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            bool whole = true;
            for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
                if (!grid.is_active(grid.cell(i, j, k))) {
                    whole = false;
                    continue;
                }
                for (unsigned c = 0; c < 4; ++c) {
                    facts.top = std::min(facts.top, metres * grid.depths[corner_index(grid.dims, i, j, k, c)]);
                    facts.base = std::max(facts.base, metres * grid.depths[corner_index(grid.dims, i, j, k, c + 4)]);
                }
            }
            if (!whole) continue;
            facts.whole_columns.push_back({i, j});
            const auto c = cell_corners(grid, i, j, 0);
            for (const auto& [a, b] : {std::array{0, 1}, {2, 3}, {0, 2}, {1, 3}})
                facts.narrowest = std::min(facts.narrowest, metres * std::hypot(c[b][0] - c[a][0], c[b][1] - c[a][1]));
        }
    }
    facts.volume = metres * metres * metres * grid::volume(grid);
    for (const auto& fault : grid.faults) facts.fault_boxes += fault.boxes.size();
    return facts;
}

std::string numbers(std::initializer_list<std::uint64_t> all) {
    std::string text;
    for (const std::uint64_t n : all) text += ' ' + std::to_string(n);
    return text;
}

/// A pressure in bar that rises with depth like that of water, and is 50 at the top at least.
double pressure(const GridFacts& facts, double depth) { return std::max(50.0, 0.1 * facts.top) + 0.1 * (depth - facts.top); }

std::string runspec(const CornerPointGrid& grid, const GridFacts& facts, const std::string& title) {
    std::string text = "RUNSPEC\n\nTITLE\n " + title + "\n\nDIMENS\n" + numbers({grid.dims[0], grid.dims[1], grid.dims[2]}) +
                       " /\n\nOIL\nWATER\nMETRIC\n\nSTART\n 1 JAN 2025 /\n\nEQLDIMS\n/\n\nTABDIMS\n/\n\nREGDIMS\n 100 /\n\n";
    if (facts.whole_columns.size() > 1) text += "WELLDIMS\n 2 " + std::to_string(grid.dims[2]) + " 1 2 /\n\n";
    if (facts.fault_boxes > 0) text += "FAULTDIM\n " + std::to_string(facts.fault_boxes) + " /\n\n";
    return text + "UNIFOUT\n\n";
}

std::string regions(const CornerPointGrid& grid, const std::vector<FipLayers>& layers) {
    if (layers.empty()) return {};
    std::string text = "REGIONS\n\nEQUALS\n";
    for (const FipLayers& l : layers)
        text += " FIPNUM" + numbers({l.number, 1, grid.dims[0], 1, grid.dims[1], l.first + std::uint64_t{1}, l.last + std::uint64_t{1}}) +
                " /\n";
    return text + "/\n\n";
}

std::string well(const std::string& name, const std::array<std::uint32_t, 2>& column) {
    return " '" + name + "' 'G' " + numbers({column[0] + std::uint64_t{1}, column[1] + std::uint64_t{1}}) + " 1* " +
           (name == "PROD" ? "OIL" : "WATER") + " /\n";
}

constexpr int steps = 6, days = 30;

std::string schedule(const CornerPointGrid& grid, const GridFacts& facts) {
    std::string text = "SCHEDULE\n\n";
    if (facts.whole_columns.size() > 1) {
        const auto &injector = facts.whole_columns.front(), &producer = facts.whole_columns.back();
        // Open in one layer each: between many layers of a high column fluid flows through the well, at rates that no step of time is
        // short enough for.
        const auto completion = [&](const std::string& name, const std::array<std::uint32_t, 2>& c, std::uint32_t layer) {
            return " '" + name + "' " + numbers({c[0] + std::uint64_t{1}, c[1] + std::uint64_t{1}, layer, layer}) + " OPEN 2* " +
                   number_text(std::min(0.2, facts.narrowest / 10)) + " /\n";
        };
        // In all a hundredth of the fluid, so that small grids are not swept within the first step.
        const std::string rate = number_text(0.01 * 0.2 * facts.volume / (steps * days));
        text += "WELSPECS\n" + well("PROD", producer) + well("INJ", injector) + "/\n\nCOMPDAT\n" + completion("PROD", producer, 1) +
                completion("INJ", injector, grid.dims[2]) + "/\n\nWCONPROD\n 'PROD' OPEN LRAT 3* " + rate + " 1* " +
                number_text(0.8 * pressure(facts, facts.top)) + " /\n/\n\nWCONINJE\n 'INJ' WATER OPEN RATE " + rate + " 1* " +
                number_text(1.2 * pressure(facts, facts.base)) + " /\n/\n\n";
    }
    return text + "TSTEP\n " + std::to_string(steps) + "*" + std::to_string(days) + " /\n\nEND\n";
}

/// The properties of cells that a deck needs, what they are where nothing is known, and where else they come from.
struct NeededProperty {
    const char *name, *like;
    double value, factor;
};
constexpr std::array needed{NeededProperty{"PORO", "", 0.2, 1}, NeededProperty{"PERMX", "", 200, 1},
                            NeededProperty{"PERMY", "PERMX", 200, 1}, NeededProperty{"PERMZ", "PERMX", 20, 0.1}};

bool has(const CornerPointGrid& grid, const std::string& name) {
    return !name.empty() && find_attribute(grid.info.attributes, name, AttributeLocation::cell) != nullptr;
}

/// Keywords that give the properties which the grid does not have.
std::string properties(const CornerPointGrid& grid) {
    std::string constant, copied, changed;
    for (const NeededProperty& p : needed) {
        if (has(grid, p.name)) continue;
        if (has(grid, p.like)) {
            copied += std::string(" ") + p.like + " " + p.name + " /\n";
            if (p.factor != 1) changed += std::string(" ") + p.name + " " + number_text(p.factor) + " /\n";
        } else {
            constant += std::string(" ") + p.name + " " + number_text(p.value) + " /\n";
        }
    }
    const auto block = [](const char* keyword, const std::string& records) {
        return records.empty() ? std::string() : std::string(keyword) + "\n" + records + "/\n\n";
    };
    return block("EQUALS", constant) + block("COPY", copied) + block("MULTIPLY", changed);
}

/// How the properties of a deck are called elsewhere, in capital letters.
struct OtherName {
    std::string_view name, keyword;
};
constexpr std::array other_names{OtherName{"POROSITY", "PORO"},       OtherName{"PHI", "PORO"},   OtherName{"PHIT", "PORO"},
                                 OtherName{"PHIE", "PORO"},           OtherName{"PERM", "PERMX"}, OtherName{"PERMEABILITY", "PERMX"},
                                 OtherName{"PERMEABILITYX", "PERMX"}, OtherName{"KX", "PERMX"},   OtherName{"KH", "PERMX"}};

/// Porosity and permeability under other names become those that the deck needs.
void rename_needed(CornerPointGrid& grid, std::vector<std::string>& notes) {
    for (const OtherName& other : other_names) {
        if (has(grid, std::string(other.keyword))) continue;
        for (Attribute& a : grid.info.attributes) {
            if (a.location != AttributeLocation::cell || !same_word(a.name, other.name) || a.components != 1) continue;
            notes.push_back(geomend::quoted(a.name) + " is " + std::string(other.keyword) + " in the deck");
            a.name = other.keyword;
            break;
        }
    }
}

/// Whether a simulator takes a value of a keyword.
bool is_possible(std::string_view keyword, double value) {
    if (keyword == "PORO" || keyword == "NTG") return value >= 0 && value <= 1;
    if (keyword.starts_with("PERM")) return value >= 0 && value < 1e20;
    return !keyword.starts_with("MULT") || (value >= 0 && value < 1e20);
}

/// Gives active cells without a value, or with one that cannot be, another one; how many there were comes back.
std::uint64_t fill_missing(const CornerPointGrid& grid, double value, Attribute& a) {
    auto* values = std::get_if<std::vector<double>>(&a.values);
    if (values == nullptr) return 0;
    std::uint64_t filled = 0;
    for (std::size_t c = 0; c < values->size(); ++c) {
        const bool is_there = !(a.no_data && is_no_data(a, (*values)[c]));
        if (!grid.is_active(c) || (is_there && is_possible(a.name, (*values)[c]))) continue;
        (*values)[c] = value;
        ++filled;
    }
    return filled;
}

}  // namespace

std::vector<std::string> fit_for_deck(CornerPointGrid& grid) {
    std::vector<std::string> notes;
    rename_needed(grid, notes);
    for (const char* keyword : {"NTG", "MULTX", "MULTY", "MULTZ", "MULTPV"}) {
        for (Attribute& a : grid.info.attributes) {
            if (a.name != keyword || a.location != AttributeLocation::cell) continue;
            if (const std::uint64_t n = fill_missing(grid, 1, a); n > 0)
                notes.push_back(geomend::quoted(a.name) + " has no value, or one that cannot be, in " +
                                counted(n, "active cell", "active cells") + ": the deck has 1 there");
        }
    }
    for (const NeededProperty& p : needed) {
        if (!has(grid, p.name) && !has(grid, p.like))
            notes.push_back("there is no " + std::string(p.name) + " among the properties: the deck has " + number_text(p.value));
    }
    std::erase_if(grid.info.attributes, [&](const Attribute& a) {
        const auto keyword = grdecl::cell_keyword(a.name);
        if (!keyword || keyword->section != grdecl::Section::regions) return false;
        if (a.name != "FIPNUM") notes.push_back("the deck has one table of each kind only: " + geomend::quoted(a.name) + " is left out");
        return true;
    });
    for (const NeededProperty& p : needed) {
        for (Attribute& a : grid.info.attributes) {
            if (a.name != p.name || a.location != AttributeLocation::cell) continue;
            if (const std::uint64_t n = fill_missing(grid, p.value, a); n > 0)
                notes.push_back(geomend::quoted(a.name) + " has no value, or one that cannot be, in " +
                                counted(n, "active cell", "active cells") + ": the deck has " + number_text(p.value) + " there");
        }
    }
    return notes;
}

Result<std::uint64_t> connections_in_deck(const CornerPointGrid& grid) {
    CornerPointGrid whole = grid;
    for (const NeededProperty& p : needed) {
        if (has(whole, p.name)) continue;
        Attribute a;
        a.name = p.name;
        a.location = AttributeLocation::cell;
        std::vector<double> values(grid.cell_count(), p.value);
        if (has(whole, p.like)) {
            const Attribute* like = find_attribute(whole.info.attributes, p.like, AttributeLocation::cell);
            for (std::size_t c = 0; c < values.size(); ++c) values[c] = p.factor * value_as_double(*like, c);
        }
        a.values = std::move(values);
        whole.info.attributes.push_back(std::move(a));
    }
    std::vector<Finding> ignored;
    if (auto computed = compute_connections(whole, false, ignored); !computed) return std::move(computed).why();
    return whole.connections.size();
}

std::string flow_deck(const CornerPointGrid& grid, const std::string& title, const std::string& include,
                      const std::vector<FipLayers>& layers) {
    const GridFacts facts = facts_of(grid);
    const double contact = (facts.top + facts.base) / 2;
    return runspec(grid, facts, title) + "GRID\n\nINIT\n\nGRIDFILE\n 0 1 /\n\nINCLUDE\n '" + include + "' /\n\n" + properties(grid) +
           "PROPS\n\nPVTW\n 200 1.02 4.5E-5 0.5 0 /\n\nPVDO\n 1 1.2 1\n 200 1.15 1.1\n 2000 1.1 1.5 /\n\nROCK\n 200 5E-5 /\n\n"
           "DENSITY\n 850 1020 1 /\n\nSWOF\n 0.2 0 1 0\n 0.5 0.2 0.3 0\n 0.8 1 0 0 /\n\n" +
           regions(grid, layers) + "SOLUTION\n\nEQUIL\n " + number_text(facts.top) + ' ' + number_text(pressure(facts, facts.top)) + ' ' +
           number_text(contact) + " 0 " + number_text(facts.top - 1000) + " 0 /\n\nSUMMARY\n\nFPR\nFOPR\nFWIR\n\n" + schedule(grid, facts);
}

}  // namespace geomend
