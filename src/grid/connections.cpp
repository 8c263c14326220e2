// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/connections.h"

#include <algorithm>

#include "base/parallel.h"
#include "grid/pillar_nodes.h"

namespace geomend::grid {

namespace {

// Corners of the top of a cell that lie on its side towards a neighbour: on pillar a and on pillar b.
constexpr std::array<std::array<unsigned, 2>, 4> side_corners{{{0, 2}, {1, 3}, {0, 1}, {2, 3}}};

// Cells lie upright and each active one below the last one.
bool in_order(std::span<const Side> sides, std::span<const std::uint8_t> active) {
    const Side* above = nullptr;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (active[k] == 0) continue;
        if (!sides[k].upright()) return false;
        if (above != nullptr && (sides[k].top_a < above->bottom_a || sides[k].top_b < above->bottom_b)) return false;
        above = &sides[k];
    }
    return true;
}

void column_presence(const CornerPointGrid& grid, std::span<const std::uint8_t> present, std::uint32_t i, std::uint32_t j,
                     std::vector<std::uint8_t>& column) {
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    column.resize(grid.dims[2]);
    std::size_t cell = grid.cell(i, j, 0);
    for (std::uint8_t& p : column) {
        p = present[cell];
        cell += layer;
    }
}

struct RowResult {
    std::vector<NonNeighbour> along_i, along_j;
    std::uint64_t internal = 0;
};

void connect_row(const CornerPointGrid& grid, std::uint32_t j, PairSides& sides, Connections& to, RowResult& row) {
    each_pair_of_row(grid, j, [&](const ColumnPair& pair) {
        load(grid, to.present, pair, sides);
        const auto first = static_cast<std::uint32_t>(grid.cell(pair.i, pair.j, 0));
        const std::uint32_t second = first + (pair.along_i ? 1 : grid.dims[0]);
        const std::uint32_t layer = grid.dims[0] * grid.dims[1];
        each_contact(sides, [&](std::uint32_t k, std::uint32_t m) {
            if (!on_same_pillars(grid, k, m)) return;
            ++row.internal;
            if (k == m) to.neighbours[first + std::size_t{layer} * k] |= pair.along_i ? Connections::east : Connections::south;
            else
                (pair.along_i ? row.along_i : row.along_j)
                    .push_back({first + layer * k, second + layer * m, pair.along_i ? CellFace::i_plus : CellFace::j_plus});
        });
    });
}

void connect_downwards(const CornerPointGrid& grid, std::uint32_t j, Connections& to, RowResult& row) {
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    std::vector<std::uint32_t> above(grid.dims[0], grid.dims[2]);  // layer of the last present cell, per column
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            const std::size_t column = grid.cell(i, j, 0);
            if (to.present[column + k * layer] == 0) continue;
            if (above[i] < grid.dims[2] && stacked(grid, i, j, above[i], k)) {
                to.neighbours[column + above[i] * layer] |= Connections::below;
                ++row.internal;
            }
            above[i] = k;
        }
    }
}

}  // namespace

std::size_t next_below(const CornerPointGrid& grid, std::span<const std::uint8_t> present, std::size_t cell) {
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1], cells = grid.cell_count();
    for (std::size_t next = cell + layer; next < cells; next += layer) {
        if (present[next] != 0) return next;
    }
    return cells;
}

bool on_same_pillars(const CornerPointGrid& grid, std::uint32_t one, std::uint32_t two) {
    return grid.reservoirs.empty() || pillar_set(grid, one) == pillar_set(grid, two);
}

bool stacked(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t upper, std::uint32_t lower) {
    if (!on_same_pillars(grid, upper, lower)) return false;
    const double* bottom = grid.depths.data() + corner_index(grid.dims, i, j, upper, 4);
    const double* top = grid.depths.data() + corner_index(grid.dims, i, j, lower, 0);
    const std::size_t row = 2 * std::size_t{grid.dims[0]};
    return bottom[0] == top[0] && bottom[1] == top[1] && bottom[row] == top[row] && bottom[row + 1] == top[row + 1];
}

void column_sides(ColumnDepths& depths, std::uint32_t i, std::uint32_t j, CellFace face, std::span<Side> sides) {
    const auto [a, b] = side_corners[static_cast<std::size_t>(face)];
    const std::size_t column = 2 * std::size_t{i}, row = 2 * std::size_t{j};
    const double* at_a = depths.column(column + (a & 1u), row + (a >> 1));
    const double* at_b = depths.column(column + (b & 1u), row + (b >> 1));
    for (std::size_t k = 0; k < sides.size(); ++k) sides[k] = {at_a[2 * k], at_b[2 * k], at_a[2 * k + 1], at_b[2 * k + 1]};
}

void load(const CornerPointGrid& grid, std::span<const std::uint8_t> present, const ColumnPair& pair, PairSides& sides) {
    const std::uint32_t i2 = pair.i + (pair.along_i ? 1 : 0), j2 = pair.j + (pair.along_i ? 0 : 1);
    sides.first.resize(grid.dims[2]);
    sides.second.resize(grid.dims[2]);
    column_sides(sides.depths, pair.i, pair.j, pair.along_i ? CellFace::i_plus : CellFace::j_plus, sides.first);
    column_sides(sides.depths, i2, j2, pair.along_i ? CellFace::i_minus : CellFace::j_minus, sides.second);
    column_presence(grid, present, pair.i, pair.j, sides.first_active);
    column_presence(grid, present, i2, j2, sides.second_active);
    sides.ordered = in_order(sides.first, sides.first_active) && in_order(sides.second, sides.second_active);
}

Connections connections(const CornerPointGrid& grid) { return connections(grid, SimulatedCells{present_cells(grid), {}, {}, {}}); }

Connections connections(const CornerPointGrid& grid, SimulatedCells cells) {
    Connections result;
    result.neighbours.assign(grid.cell_count(), 0);
    result.present = std::move(cells.present);
    result.bridges = std::move(cells.bridges);
    result.internal = result.bridges.size();
    std::vector<RowResult> rows(grid.dims[1]);
    parallel_blocks(rows.size(), 1, [&](std::size_t first, std::size_t last) {
        PairSides sides(grid);
        for (std::size_t j = first; j < last; ++j) {
            connect_row(grid, static_cast<std::uint32_t>(j), sides, result, rows[j]);
            connect_downwards(grid, static_cast<std::uint32_t>(j), result, rows[j]);
        }
    });
    for (const RowResult& row : rows) {
        result.internal += row.internal;
        result.others.insert(result.others.end(), row.along_i.begin(), row.along_i.end());
    }
    for (const RowResult& row : rows) result.others.insert(result.others.end(), row.along_j.begin(), row.along_j.end());
    return result;
}

}  // namespace geomend::grid
