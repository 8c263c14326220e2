// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hexes/candidates.h"

namespace geomend::hexes {

/// Cells of several types that conform to each other, with the way back to the tetrahedra they were made from.
struct MixedMesh {
    std::vector<Vec3> positions;  ///< those of the tetrahedra, then new ones
    /// A new vertex lies in a region, near the middle of these four.
    struct NewVertex {
        std::array<std::uint32_t, 4> near;
        std::uint32_t region;
    };
    std::vector<NewVertex> new_vertices;

    struct Cell {
        CellType type;
        std::array<std::uint32_t, 8> corners;
        std::uint32_t region;
        std::uint32_t tet;  ///< the largest tetrahedron that it holds a part of
    };
    std::vector<Cell> cells;

    /// Per facet of the tetrahedra that lies on a wall: the cell and local face it became, or a part of. no_index for other facets.
    std::vector<CellFaceRef> facet_places;
};

/// How quadrangles that have tetrahedra behind them are made to conform.
enum class Closing : std::uint8_t {
    open,   ///< no cell is lost: pyramids, where need be over one new vertex, behind the quadrangle
    split,  ///< cells with such a quadrangle are split into pyramids and tetrahedra about their middle (Botella 2016, 3.4.5)
};

/// What it took.
struct ClosingCounts {
    std::uint64_t quads = 0;     ///< quadrangles with tetrahedra behind them
    std::uint64_t absorbed = 0;  ///< tetrahedra on a quadrangle that became a part of it
    std::uint64_t pyramids = 0;  ///< from two tetrahedra that shared an apex
    std::uint64_t opened = 0;    ///< diagonals that a new vertex took the place of
    std::uint64_t split = 0;     ///< cells that were split
};

/// Puts selected candidates in the place of their tetrahedra and makes the mesh conform. A quadrangle that no cell shares: at the end of
/// the mesh it stays. A tetrahedron on it with the same four corners is absorbed, and what is behind looked at. Two tetrahedra with the
/// same apex become a pyramid. Else the diagonal is opened: a new vertex in the fan of tetrahedra around it becomes the apex of a
/// pyramid, and each tetrahedron of the fan becomes two. Where shape forbids that, the cell is split. Walls stay; a quadrangle on a wall
/// is one on both sides. \param failed gets the candidates that were split, ascending. \pre the selected stand together. Cost: linear, 50
/// microseconds for an opened diagonal.
MixedMesh close(const TetMesh& mesh, const Candidates& candidates, std::span<const std::uint32_t> selected, Closing how,
                ClosingCounts& counts, std::vector<std::uint32_t>& failed);

}  // namespace geomend::hexes
