// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grid/column_depths.h"
#include "grid/side_overlap.h"
#include "grid/simulated_cells.h"
#include "model/corner_point.h"

// Which active cells touch. Cells of neighbouring columns do where their sides share area; cells of one column where
// bottom and top coincide on all four pillars and nothing active lies between. The geometry of inactive cells is never
// looked at, and active cells without any thickness count as inactive. That is the rule of simulators that process corner-point grids
// (opm-grid among them), so that the same pairs come out.

namespace geomend::grid {

/// A pair of cells that are not neighbours by (i,j,k) but touch across a fault or past pinched cells.
struct NonNeighbour {
    std::uint32_t first = 0, second = 0;  ///< cells; first has the lower i (or j)
    CellFace face = CellFace::i_plus;     ///< of the first cell: i_plus, j_plus; k_plus for bridged gaps
    bool operator==(const NonNeighbour&) const = default;
};

struct Connections {
    /// Bits of one cell: it touches the next active cell in +I, +J (same k) or downwards (next active one).
    enum Neighbour : std::uint8_t { east = 1, south = 2, below = 4 };
    std::vector<std::uint8_t> neighbours;  ///< per cell
    std::vector<NonNeighbour> others;      ///< sorted by direction, column, then cells
    std::uint64_t internal = 0;            ///< all pairs: neighbours and others
    std::vector<std::uint8_t> present;     ///< per cell, as present_cells() gives it
    /// Pairs that a simulator joins though nothing of theirs touches, as SimulatedCells has them.
    std::vector<std::array<std::size_t, 2>> bridges;
};

/// \pre misfit(grid) is empty; fewer than 2^32 cells
/// Cost: linear in cells where columns are in order; quadratic in layers for columns whose cells overlap.
Connections connections(const CornerPointGrid& grid);

/// The same of the cells that a simulator keeps, with what it bridges.
Connections connections(const CornerPointGrid& grid, SimulatedCells cells);

/// The next present cell below, in the same column, or grid.cell_count().
std::size_t next_below(const CornerPointGrid& grid, std::span<const std::uint8_t> present, std::size_t cell);

/// True where two layers use the same set of coordinate lines.
bool on_same_pillars(const CornerPointGrid& grid, std::uint32_t one, std::uint32_t two);

/// True where the bottom of one cell is the top of another of the same column, on all four pillars.
/// \param upper, lower layers of column (i,j)
bool stacked(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t upper, std::uint32_t lower);

/// The sides that the cells of column (i,j) turn to a neighbour, one per layer; face is one of the four lateral ones.
/// Pillar a is the one with the lower j (for i faces) or the lower i (for j faces).
void column_sides(ColumnDepths& depths, std::uint32_t i, std::uint32_t j, CellFace face, std::span<Side> sides);

/// Two columns side by side.
struct ColumnPair {
    std::uint32_t i, j;                ///< of the first column
    bool along_i;                      ///< the second one is (i+1,j), else (i,j+1)
    std::uint32_t pillar_a, pillar_b;  ///< numbers of the pillars between them
};

/// Buffers for one pair of columns, reused from pair to pair.
struct PairSides {
    explicit PairSides(const CornerPointGrid& grid) : depths(grid) {}
    ColumnDepths depths;
    std::vector<Side> first, second;
    std::vector<std::uint8_t> first_active, second_active;
    bool ordered = false;  ///< active cells of both columns lie one below the other, upright
};

/// Fills the buffers for a pair, those made for this grid; cells that are not present count as inactive.
void load(const CornerPointGrid& grid, std::span<const std::uint8_t> present, const ColumnPair& pair, PairSides& sides);

/// Calls body(k of the first column, k of the second) for each pair of active cells whose sides share area, ascending.
template <class Body>
void each_contact(const PairSides& sides, const Body& body);

/// Calls body(pair) for the pairs of one row j: all (i,j)-(i+1,j), then all (i,j)-(i,j+1).
template <class Body>
void each_pair_of_row(const CornerPointGrid& grid, std::uint32_t j, const Body& body) {
    const std::uint32_t lines = grid.dims[0] + 1;
    for (std::uint32_t i = 0; i + 1 < grid.dims[0]; ++i) {
        const std::uint32_t a = i + 1 + lines * j;
        body(ColumnPair{i, j, true, a, a + lines});
    }
    if (j + 1 >= grid.dims[1]) return;
    for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
        const std::uint32_t a = i + lines * (j + 1);
        body(ColumnPair{i, j, false, a, a + 1});
    }
}

template <class Body>
void each_contact(const PairSides& sides, const Body& body) {
    const auto layers = static_cast<std::uint32_t>(sides.first.size());
    std::uint32_t start = 0;
    for (std::uint32_t k = 0; k < layers; ++k) {
        if (sides.first_active[k] == 0) continue;
        const Side& one = sides.first[k];
        if (!sides.ordered) start = 0;
        for (std::uint32_t m = start; m < layers; ++m) {
            if (sides.second_active[m] == 0) {
                if (m == start && sides.ordered) ++start;
                continue;
            }
            const Side& other = sides.second[m];
            if (sides.ordered) {
                if (other.bottom_a <= one.top_a && other.bottom_b <= one.top_b) {
                    if (m == start) ++start;
                    continue;
                }
                if (other.top_a >= one.bottom_a && other.top_b >= one.bottom_b) break;
            }
            if (overlaps(one, other)) body(k, m);
        }
    }
}

}  // namespace geomend::grid
