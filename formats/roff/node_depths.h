// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/corner_point.h"

// Depths of a ROFF grid stand on nodes: (nx+1)(ny+1)(nz+1), i slowest, k fastest and from the bottom. A node has 1 depth,
// 2 (below, above), 4 (of the columns SW SE NW NE) or 8 (those four below, then above).

namespace geomend::roff {

/// The depths at a node of the up to eight cells around it: below SW SE NW NE, above SW SE NW NE.
struct NodeDepths {
    std::array<double, 8> depth{};
    unsigned known = 0;  ///< a bit for each cell that there is
};

inline NodeDepths depths_at(const CornerPointGrid& grid, std::size_t i, std::size_t j, std::size_t k) {
    NodeDepths node;
    const auto [nx, ny, nz] = grid.dims;
    for (unsigned v = 0; v < 8; ++v) {
        const std::size_t right = v & 1u, north = (v >> 1) & 1u, above = v >> 2;
        const std::size_t ci = i + right - 1, cj = j + north - 1;  // wraps where there is no cell
        const std::size_t layer = above != 0 ? nz - 1 - k : nz - k;
        if (ci >= nx || cj >= ny || layer >= nz) continue;
        const auto corner = static_cast<unsigned>((1 - right) + 2 * (1 - north) + 4 * above);
        node.depth[v] = grid.depths[corner_index(grid.dims, ci, cj, layer, corner)];
        node.known |= 1u << v;
    }
    // Where there is no cell the depth of the one above or below stands, else that of another one on the same side,
    // else that of any: so that no more depths are needed than for the cells that there are.
    if (node.known == 255u || node.known == 0) return node;
    const auto is_known = [&](unsigned v) { return (node.known >> v & 1u) != 0; };
    for (unsigned v = 0; v < 8; ++v) {
        if (is_known(v)) continue;
        unsigned from = v ^ 4u;
        for (unsigned w = 0; w < 8 && !is_known(from); ++w) from = w < 4 ? (v & 4u) + w : (~v & 4u) + w - 4;
        node.depth[v] = node.depth[from];
    }
    return node;
}

/// The least number of depths that gives each cell its own.
std::vector<std::uint8_t> node_splits(const CornerPointGrid& grid);

/// Calls put(depth) for the depths of the nodes of one i, in the file's order.
template <class Put>
void for_each_node_depth(const CornerPointGrid& grid, const std::vector<std::uint8_t>& splits, std::size_t i, const Put& put) {
    std::size_t n = i * (std::size_t{grid.dims[1]} + 1) * (std::size_t{grid.dims[2]} + 1);
    for (std::size_t j = 0; j <= grid.dims[1]; ++j) {
        for (std::size_t k = 0; k <= grid.dims[2]; ++k, ++n) {
            const NodeDepths node = depths_at(grid, i, j, k);
            const unsigned split = splits[n];
            for (unsigned v = 0; v < split; ++v) put(node.depth[split == 2 ? 4 * v : v]);
        }
    }
}

}  // namespace geomend::roff
