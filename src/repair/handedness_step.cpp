// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <string_view>

#include "repair/grid_steps.h"
#include "validators/cell_findings.h"

// The rows of a grid in the opposite order: J counts the other way, so that what was left-handed becomes right-handed.
// No cell moves; all that is said of cells goes with them.

namespace geomend::repair {

namespace {

// The place of a cell after the reversal; of the fracture's numbers (from the number of cells on), too.
std::uint64_t reversed_cell(const std::array<std::uint32_t, 3>& dims, std::uint64_t cell) {
    const std::uint64_t row = cell / dims[0], j = row % dims[1];
    return cell + (dims[1] - 1 - 2 * j) * dims[0];  // unsigned numbers wrap round to what is meant
}

template <class T>
void reverse_rows(std::vector<T>& values, const std::array<std::uint32_t, 3>& dims, std::size_t components) {
    const std::size_t row = std::size_t{dims[0]} * components, layer = row * dims[1];
    for (std::size_t k = 0; (k + 1) * layer <= values.size(); ++k) {
        for (std::size_t j = 0; j < dims[1] / 2; ++j) {
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * layer + j * row);
            const auto last = values.begin() + static_cast<std::ptrdiff_t>(k * layer + (dims[1] - 1 - j) * row);
            std::swap_ranges(first, first + static_cast<std::ptrdiff_t>(row), last);
        }
    }
}

// Corner depths are 2 nx by 2 ny values in each of the 2 nz planes; pillars 6 (nx+1) by ny+1 in each set.
void reverse_geometry(CornerPointGrid& grid) {
    reverse_rows(grid.depths, {2 * grid.dims[0], 2 * grid.dims[1], 1}, 1);
    reverse_rows(grid.pillars, {grid.dims[0] + 1, grid.dims[1] + 1, 1}, 6);
    reverse_rows(grid.activity, grid.dims, 1);
}

void swap_ends(std::uint32_t& first, std::uint32_t& last, std::uint32_t rows) {
    const std::uint32_t end = rows - 1 - first;  // records outside the grid wrap round and stay outside
    first = rows - 1 - last;
    last = end;
}

// What belongs to the +J side of a cell belongs to its -J side now, and the other way round.
std::string_view other_side(std::string_view name) {
    if (name == "MULTY") return "MULTY-";
    if (name == "MULTY-") return "MULTY";
    return {};
}

// TRANY is between a cell and the one behind it in +J: that is the row before now.
void shift_row(Attribute& a, const std::array<std::uint32_t, 3>& dims) {
    std::visit(
        [&]<class T>(std::vector<T>& values) {
            const std::size_t row = std::size_t{dims[0]} * a.components, layer = row * dims[1];
            for (std::size_t from = 0; from + layer <= values.size(); from += layer) {
                const auto begin = values.begin() + static_cast<std::ptrdiff_t>(from);
                std::move(begin + static_cast<std::ptrdiff_t>(row), begin + static_cast<std::ptrdiff_t>(layer), begin);
                std::fill(begin + static_cast<std::ptrdiff_t>(layer - row), begin + static_cast<std::ptrdiff_t>(layer), T{});
            }
        },
        a.values);
}

void reverse_attributes(CornerPointGrid& grid) {
    for (Attribute& a : grid.info.attributes) {
        if (a.location == AttributeLocation::cell)
            std::visit([&](auto& values) { reverse_rows(values, grid.dims, a.components); }, a.values);
        if (a.location == AttributeLocation::pillar)
            std::visit([&](auto& values) { reverse_rows(values, {grid.dims[0] + 1, grid.dims[1] + 1, 1}, a.components); }, a.values);
        const std::string_view name = std::string_view(a.name).substr(0, a.name.find(':'));
        if (const std::string_view other = other_side(name); !other.empty()) a.name.replace(0, name.size(), other);
        if (name == "TRANY" && a.location == AttributeLocation::cell) shift_row(a, grid.dims);
    }
    for (NamedSet& set : grid.info.sets) {
        if (set.location != AttributeLocation::cell) continue;
        for (std::uint32_t& cell : set.members) cell = static_cast<std::uint32_t>(reversed_cell(grid.dims, cell));
        std::ranges::sort(set.members);
    }
}

void reverse_records(CornerPointGrid& grid) {
    for (auto& fault : grid.faults) {
        for (auto& box : fault.boxes) {
            swap_ends(box.first[1], box.last[1], grid.dims[1]);
            if (box.face == CellFace::j_minus) box.face = CellFace::j_plus;
            else if (box.face == CellFace::j_plus) box.face = CellFace::j_minus;
        }
    }
    for (auto& c : grid.connections) {
        c.first = reversed_cell(grid.dims, c.first);
        c.second = reversed_cell(grid.dims, c.second);
    }
    for (auto& link : grid.links) {
        for (auto& c : link.connections) c.first = reversed_cell(grid.dims, c.first);
    }
    if (grid.host && !grid.host->cells.empty()) reverse_rows(grid.host->cells, grid.dims, 1);
    if (grid.orientation.size() == 5) {
        std::string& word = grid.orientation[4];
        if (word == "RIGHT") word = "LEFT";
        else if (word == "LEFT") word = "RIGHT";
    }
}

}  // namespace

void follow_reversal(const CornerPointGrid& reversed, CornerPointGrid& other) {
    for (auto& link : other.links) {
        if (link.grid != reversed.info.name) continue;
        for (auto& c : link.connections) c.second = reversed_cell(reversed.dims, c.second);
    }
    if (!other.host) return;
    const bool hosted = other.host->grid == reversed.info.name || (other.host->grid.empty() && !reversed.host);
    if (!hosted) return;
    swap_ends(other.host->first[1], other.host->last[1], reversed.dims[1]);
    for (std::uint64_t& cell : other.host->cells) cell = reversed_cell(reversed.dims, cell);
}

StepReport handedness(CornerPointGrid& grid, const validators::GridScope& scope, const StepOptions&) {
    StepReport report;
    report.element_kind = "cell-ijk";
    if (scope.right_handed()) {
        report.message = "the cells are right-handed in (x, y, depth)";
        return report;
    }
    reverse_geometry(grid);
    reverse_attributes(grid);
    reverse_records(grid);
    report.count = grid.cell_count();
    report.message = "the rows of all cells were put in the opposite order: row j is now row " + std::to_string(grid.dims[1] + 1) +
                     " - j; attributes, faults and connections went with them";
    const std::size_t records = grid.info.annotations.size();
    if (records > 0) {
        report.message += "; " +
                          counted(records, "record that is kept as it stands may name", "records that are kept as they stand may name") +
                          " cells by their old row";
        report.measures = {{"records_as_they_stand", static_cast<double>(records)}};
    }
    return report;
}

}  // namespace geomend::repair
