// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/node_depths.h"

#include "base/parallel.h"

namespace geomend::roff {

namespace {

std::uint8_t split_of(const NodeDepths& node) {
    const auto& z = node.depth;
    bool level = true, joined = true;  // all columns alike; above as below
    for (unsigned v = 0; v < 4; ++v) {
        level = level && z[v] == z[0] && z[v + 4] == z[4];
        joined = joined && z[v] == z[v + 4];
    }
    if (level) return joined ? 1 : 2;
    return joined ? 4 : 8;
}

}  // namespace

std::vector<std::uint8_t> node_splits(const CornerPointGrid& grid) {
    const std::size_t nodes_y = std::size_t{grid.dims[1]} + 1, nodes_z = std::size_t{grid.dims[2]} + 1;
    std::vector<std::uint8_t> splits((std::size_t{grid.dims[0]} + 1) * nodes_y * nodes_z);
    parallel_blocks(std::size_t{grid.dims[0]} + 1, 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i != to; ++i) {
            for (std::size_t j = 0; j != nodes_y; ++j) {
                for (std::size_t k = 0; k != nodes_z; ++k) splits[(i * nodes_y + j) * nodes_z + k] = split_of(depths_at(grid, i, j, k));
            }
        }
    });
    return splits;
}

}  // namespace geomend::roff
