// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "model/objects.h"

// Which node speaks for which cell of an SGrid, and the flags that a node has by its place.

namespace geomend::gocad {

/// Nodes and cells of a grid in array order (i fastest). A direction with one node has one layer of cells, so that flat
/// grids have quads.
struct SGridLayout {
    std::array<std::uint32_t, 3> nodes;
    std::array<std::uint32_t, 3> cells;

    explicit SGridLayout(const std::array<std::uint32_t, 3>& dims) : nodes(dims), cells(dims) {
        for (std::uint32_t& n : cells) n = n > 1 ? n - 1 : 1;
        if (nodes == std::array<std::uint32_t, 3>{1, 1, 1}) cells = {0, 0, 0};
    }
    std::uint64_t node_count() const { return std::uint64_t{nodes[0]} * nodes[1] * nodes[2]; }
    std::uint64_t cell_count() const { return std::uint64_t{cells[0]} * cells[1] * cells[2]; }
    std::array<std::uint32_t, 3> place(std::uint64_t node) const {
        const std::uint64_t row = node / nodes[0];
        return {static_cast<std::uint32_t>(node % nodes[0]), static_cast<std::uint32_t>(row % nodes[1]),
                static_cast<std::uint32_t>(row / nodes[1])};
    }
    /// The cell whose lowest node this is, or no_index.
    std::uint32_t cell_of_node(std::uint64_t node) const {
        const auto [i, j, k] = place(node);
        if (i >= cells[0] || j >= cells[1] || k >= cells[2]) return no_index;
        return i + cells[0] * (j + cells[1] * k);
    }
    std::uint64_t node_of_cell(std::uint32_t cell) const {
        const std::uint32_t row = cell / cells[0];
        return cell % cells[0] + std::uint64_t{nodes[0]} * (row % cells[1] + std::uint64_t{nodes[1]} * (row / cells[1]));
    }
    /// The flags of a node as decoded from a real file: bits 0-2 a neighbour in +U, +V, +W, bits 3-5 in -U, -V, -W;
    /// bits 12-14 and 15-17 the borders there. Which of the two border bits stands for which end is our reading.
    std::uint32_t node_flags(std::uint64_t node) const {
        const auto at = place(node);
        std::uint32_t flags = 0;
        for (std::uint32_t d = 0; d < 3; ++d) {
            const bool last = at[d] + 1 >= nodes[d];
            const bool first = at[d] == 0;
            flags |= (last ? 1u << (12 + d) : 1u << d) | (first ? 1u << (15 + d) : 1u << (3 + d));
        }
        return flags;
    }
};

/// The region by which blanked cells go out and come back.
inline constexpr const char* dead_cells_region = "geomend_dead_cells";

}  // namespace geomend::gocad
