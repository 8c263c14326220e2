// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "hexes/pair_set.h"
#include "model/volume_mesh.h"

namespace geomend::hexes {

/// The tetrahedra of a mesh with what lies beside each facet. Facet k of tetrahedron t is opposite to its corner k, and has the
/// number 4 t + k.
struct TetMesh {
    static constexpr std::uint32_t no_wall = 0;    ///< a facet inside of a region
    static constexpr std::uint32_t held_wall = 1;  ///< a facet that no quadrangle may cover: a cell of another type is behind it

    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 4>> tets;    ///< wound so that their volumes are positive, as far as they have any
    std::vector<std::array<std::uint32_t, 4>> across;  ///< per facet the facet on its other side, or no_index
    std::vector<std::uint32_t> region;                 ///< per tetrahedron
    std::vector<std::array<std::uint32_t, 4>> wall;    ///< per facet what it lies on: equal numbers, the same surfaces on its two sides
    PairSet wall_edges;                                ///< edges of facets that lie on something
    PairSet lines;                     ///< edges that must stay: of lines and wells, and where walls end, meet or have a crease
    std::vector<std::uint32_t> cells;  ///< per tetrahedron the cell of the mesh it was

    /// Tetrahedra around each vertex, ascending.
    std::vector<std::uint32_t> star_offsets, star;

    std::array<std::uint32_t, 3> facet(std::uint32_t number) const;  ///< its corners, wound outwards
};

/// The corners of facet k of a tetrahedron, wound outwards.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> facet_corners{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Finds what lies across each facet: facets with the same three corners are two sides of one. Cost: n log n
void find_across(TetMesh& mesh);

/// Takes the tetrahedra of a mesh. Walls are facets in sets of faces, between regions, and at the end of the mesh; lines are the
/// edges of sets of edges, and those where other than two facets of one wall meet, or two at more than 40 degrees.
/// Cost: n log n. \pre the mesh is not split (exchange::joined())
TetMesh tet_mesh_of(const VolumeMesh& mesh);

}  // namespace geomend::hexes
