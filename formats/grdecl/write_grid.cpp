// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/own_name.h"
#include "base/text_cursor.h"
#include "formats/grdecl/deck.h"
#include "formats/grdecl/value_text.h"
#include "formats/grdecl/writing.h"

namespace geomend::grdecl {

namespace {

bool is_dual(const CornerPointGrid& grid) { return grid.porosity != CornerPointGrid::Porosity::single && !grid.host; }

void put_numbers(OutputFile& out, std::span<const double> numbers, std::size_t per_line) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        out << ' ';
        out.number(numbers[i]);
        if ((i + 1) % per_line == 0 && i + 1 < numbers.size()) out << '\n';
    }
}

void put_box(OutputFile& out, const std::array<std::uint32_t, 3>& first, const std::array<std::uint32_t, 3>& last) {
    for (std::size_t a = 0; a < 3; ++a) {
        out << ' ';
        out.number(first[a] + 1);
        out << ' ';
        out.number(last[a] + 1);
    }
}

std::string_view face_word(CellFace face) {
    constexpr std::array<std::string_view, 6> words = {"X-", "X", "Y-", "Y", "Z-", "Z"};
    return words[static_cast<std::size_t>(face)];
}

/// The names of faults as decks can hold them, each of another fault: by the names that they have.
std::map<std::string, std::string> names_of_faults(const CornerPointGrid& grid, std::vector<Loss>& losses) {
    std::map<std::string, std::string> written;
    std::set<std::string> taken;
    for (const auto& fault : grid.faults) {
        if (quotable(fault.name) == fault.name) taken.insert(written.emplace(fault.name, fault.name).first->second);
    }
    for (const auto& fault : grid.faults) {
        if (written.contains(fault.name)) continue;
        std::string name = own_name(quotable(fault.name), taken);
        add_loss(losses, {LossClass::identity, grid.info.name, "name of fault '" + fault.name + "'",
                          "decks hold no line ends in names, and quotes of one kind: it is written as " + in_quotes(name), 1});
        written.emplace(fault.name, std::move(name));
    }
    return written;
}

void write_faults(const CornerPointGrid& grid, DeckOutput& to) {
    OutputFile& out = to.main;
    const auto names = names_of_faults(grid, to.losses);
    const auto has_boxes = [](const auto& f) { return !f.boxes.empty(); };
    const auto has_multiplier = [](const auto& f) { return f.multiplier.has_value(); };
    if (std::ranges::any_of(grid.faults, has_boxes)) {
        out << "FAULTS\n";
        for (const auto& fault : grid.faults) {
            for (const auto& box : fault.boxes) {
                out << ' ' << in_quotes(names.at(fault.name));
                put_box(out, box.first, box.last);
                out << " '" << face_word(box.face) << "' /\n";
            }
        }
        out << "/\n\n";
    }
    if (!std::ranges::any_of(grid.faults, has_multiplier)) return;
    out << "MULTFLT\n";
    for (const auto& fault : grid.faults) {
        if (!fault.multiplier) continue;
        out << ' ' << in_quotes(names.at(fault.name)) << ' ';
        out.number(*fault.multiplier);
        out << " /\n";
    }
    out << "/\n\n";
}

void put_cell(OutputFile& out, const CornerPointGrid& grid, std::uint64_t cell) {
    const std::uint64_t row = cell / grid.dims[0];
    for (const std::uint64_t index : {cell % grid.dims[0], row % grid.dims[1], row / grid.dims[1]}) {
        out << ' ';
        out.number(index + 1);
    }
}

void write_connections(const CornerPointGrid& grid, DeckOutput& to) {
    OutputFile& out = to.main;
    const std::uint64_t cells = grid.cell_count() * (is_dual(grid) ? 2 : 1);
    const auto has_place = [&](const CornerPointGrid::Connection& c) { return c.first < cells && c.second < cells; };
    const auto kept = std::ranges::count_if(grid.connections, has_place);
    const std::uint64_t lost = grid.connections.size() - static_cast<std::uint64_t>(kept);
    if (lost != 0)
        to.losses.push_back({LossClass::substance, grid.info.name, "connections of cells of the fracture",
                             "the layers of a local grid are those of the matrix", lost});
    if (kept == 0) return;
    out << "NNC\n";
    for (const auto& c : grid.connections) {
        if (!has_place(c)) continue;
        put_cell(out, grid, c.first);
        put_cell(out, grid, c.second);
        if (c.transmissibility) {
            out << ' ';
            out.number(*c.transmissibility);
        }
        out << " /\n";
    }
    out << "/\n\n";
}

void write_pinch(const CornerPointGrid& grid, OutputFile& out) {
    if (grid.pinch) {
        out << "PINCH\n ";
        out.number(grid.pinch->threshold);
        out << (grid.pinch->gap ? " GAP " : " NOGAP ");
        out.number(grid.pinch->largest_gap);
        out << (grid.pinch->all_layers ? " ALL" : " TOPBOT") << (grid.pinch->multiplier_of_all ? " ALL" : " TOP") << " /\n\n";
    }
    if (!grid.least_pore_volume) return;
    out << "MINPV\n ";
    out.number(*grid.least_pore_volume);
    out << " /\n\n";
}

void write_region_multipliers(const CornerPointGrid& grid, OutputFile& out) {
    if (grid.region_multipliers.empty()) return;
    out << "MULTREGT\n";
    for (const auto& m : grid.region_multipliers) {
        for (const auto& region : {m.from, m.to}) {
            out << ' ';
            if (region) out.number(*region);
            else out << "1*";
        }
        out << ' ';
        out.number(m.value);
        out << ' ' << m.directions << ' ' << m.connections << ' ' << m.regions << " /\n";
    }
    out << "/\n\n";
}

}  // namespace

std::string_view unit_word(std::string_view unit) {
    const std::string word = upper_case(trimmed(unit));
    if (word == "METRES" || word == "METERS" || word == "METRE" || word == "METER" || word == "M") return "METRES";
    if (word == "FEET" || word == "FOOT" || word == "FT") return "FEET";
    return word == "CM" || word == "CENTIMETRES" || word == "CENTIMETERS" ? "CM" : "";
}

void write_head(const CornerPointGrid& grid, DeckOutput& to) {
    OutputFile& out = to.main;
    if (!grid.map_unit.empty()) out << "MAPUNITS\n '" << grid.map_unit << "' /\n\n";
    if (grid.map_axes) {
        out << "MAPAXES\n";
        put_numbers(out, *grid.map_axes, 2);
        out << " /\n\n";
    }
    const auto& units = grid.info.crs.axis_units;
    const std::string_view unit = unit_word(units[0]);
    const bool one = units[0] == units[1] && units[0] == units[2];
    if (one && !unit.empty()) out << "GRIDUNIT\n '" << unit << "'" << (grid.map_relative ? " 'MAP'" : "") << " /\n\n";
    else if (!units[0].empty() || !units[2].empty())
        to.losses.push_back(
            {LossClass::identity, grid.info.name, "units of the axes", "GRIDUNIT knows METRES, FEET and CM for all axes", 1});
    if (to.deck && radial_blocks(grid)) return;  // RUNSPEC states its numbers of cells
    out << "SPECGRID\n ";
    out.number(grid.dims[0]) << ' ';
    out.number(grid.dims[1]) << ' ';
    out.number(grid.dims[2] * (is_dual(grid) ? 2 : 1)) << ' ';
    out.number(std::max<std::uint64_t>(1, grid.reservoirs.size())) << (grid.cylindrical ? " T /\n\n" : " F /\n\n");
    if (!grid.orientation.empty()) {
        out << "GDORIENT\n";
        for (const std::string& word : grid.orientation) out << ' ' << word;
        out << " /\n\n";
    }
    if (grid.reservoirs.empty()) return;
    out << "COORDSYS\n";
    for (const auto& r : grid.reservoirs) {
        out << ' ';
        out.number(r.first_layer + 1) << ' ';
        out.number(r.last_layer + 1) << (r.complete_circle ? " COMP" : " INCOMP") << (r.joined ? " JOIN" : " SEPARATE") << " /\n";
    }
    out << '\n';
}

void write_geometry(const CornerPointGrid& grid, DeckOutput& to) {
    if (grid.depths.empty()) return;
    if (const auto blocks = to.deck ? radial_blocks(grid) : std::nullopt) return write_radial_blocks(*blocks, to);
    const std::size_t n = grid.depths.size();
    const auto bad = [](double v) { return !std::isfinite(v); };
    if (const auto count = std::ranges::count_if(grid.depths, bad) + std::ranges::count_if(grid.pillars, bad); count > 0) {
        to.losses.push_back({LossClass::substance, grid.info.name, "coordinates that are not finite",
                             "they become 1e20, which stands for none", static_cast<std::uint64_t>(count)});
    }
    const auto at = [](double v) { return Element<double>{std::isfinite(v) ? v : 1e20}; };
    write_array(to.main, "COORD", grid.pillars.size(), [&](std::size_t i) { return at(grid.pillars[i]); });
    write_array(to.main, "ZCORN", is_dual(grid) ? 2 * n : n, [&](std::size_t i) { return at(grid.depths[i < n ? i : i - n]); });
}

void write_faults_and_connections(const CornerPointGrid& grid, DeckOutput& to, bool activity_too) {
    const std::size_t cells = grid.cell_count();
    if (!grid.activity.empty() && activity_too) {
        if (is_dual(grid)) {
            write_array(to.main, "ACTNUM", 2 * cells, [&](std::size_t i) {
                return Element<std::uint32_t>{i < cells ? grid.activity[i] & 1u : (grid.activity[i - cells] >> 1) & 1u};
            });
        } else {
            write_array(to.main, "ACTNUM", cells, [&](std::size_t i) { return Element<std::uint32_t>{grid.activity[i]}; });
        }
    }
    write_faults(grid, to);
    write_pinch(grid, to.main);
    write_connections(grid, to);
    write_region_multipliers(grid, to.main);
    for (const auto& link : grid.links) {
        to.losses.push_back({LossClass::substance, grid.info.name, "connections with grid '" + link.grid + "'",
                             "decks state connections within one grid only", link.connections.size()});
    }
}

void write_local_grid_begin(const CornerPointGrid& grid, DeckOutput& to) {
    OutputFile& out = to.main;
    out << "CARFIN\n " << in_quotes(grid.info.name);
    put_box(out, grid.host->first, grid.host->last);
    for (const std::uint32_t n : grid.dims) {
        out << ' ';
        out.number(n);
    }
    if (!grid.host->grid.empty()) out << " 1* " << in_quotes(grid.host->grid);
    out << " /\n\n";
    for (std::size_t a = 0; a < 3; ++a) {
        const auto counts = fine_counts(grid, a);
        if (counts.empty() || std::ranges::all_of(counts, [&](std::uint32_t n) { return n == counts[0]; })) continue;
        constexpr std::array<std::string_view, 3> words = {"NXFIN", "NYFIN", "NZFIN"};
        write_array(out, words[a], counts.size(), [&](std::size_t i) { return Element<std::uint32_t>{counts[i]}; });
    }
}

}  // namespace geomend::grdecl
