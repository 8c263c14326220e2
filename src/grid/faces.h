// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/corner_point.h"

namespace geomend::grid {

/// All faces of the present cells of a grid, each once: where cells touch the face is theirs together, where sides only
/// partly overlap they are split, so that the cells become polyhedra which fit face to face. Every point that lies on an
/// edge of a face is a corner of it, so that the faces of a cell close exactly.
struct GridFaces {
    std::vector<Vec3> points;  ///< elevation-up; corners on pillars first, then crossings of edges between pillars
    std::vector<std::uint64_t> offsets{0};
    std::vector<std::uint32_t> nodes;  ///< face f has nodes[offsets[f] .. offsets[f+1])

    struct Face {
        std::uint32_t first;   ///< cell whose side `side` it is; corners run so that (I,J,K) sees the normal leave it
        std::uint32_t second;  ///< the other cell, or no cell: 0xffffffff
        CellFace side;
    };
    std::vector<Face> faces;
    std::vector<std::uint8_t> present;  ///< per cell of the grid, as present_cells()
    /// Pairs of columns that could not be matched because cells overlap or are folded: their sides stay whole and unshared.
    std::uint64_t unmatched_columns = 0;

    std::span<const std::uint32_t> polygon(std::size_t f) const {
        return {nodes.data() + offsets[f], static_cast<std::size_t>(offsets[f + 1] - offsets[f])};
    }
};

/// Cost: n log n in layers per column. \pre misfit(grid) is empty; fewer than 2^32 - 1 cells
GridFaces conforming_faces(const CornerPointGrid& grid);

}  // namespace geomend::grid
