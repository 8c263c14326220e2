// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.h"
#include "hexes/closing.h"
#include "hexes/tet_mesh.h"

namespace geomend::hexes {

struct LeftoverCounts {
    std::uint64_t flips = 0;   ///< of edges and faces
    std::uint64_t placed = 0;  ///< new vertices in place of flat cells
    std::uint64_t flat = 0;    ///< cells that stay without a volume
};

/// Makes the tetrahedra that no cell of another type took better, with their facets towards other cells and on walls, edges of lines and
/// all vertices fixed: the worst by flips, as volumes::improve() does; those that are flat then give way, with some around them, to
/// tetrahedra around one new vertex. Where four vertices lie in an even surface, a mesh of tetrahedra may have such cells.
/// \param beside gets the hexahedra and prisms, ascending, that stand beside cells which stay flat, or have a pyramid that does.
/// \pre `mesh` was made of `tets`, and is not smoothed. Cost: n log n in the tetrahedra left, and 1 millisecond for a flat one.
void improve_leftovers(MixedMesh& mesh, const TetMesh& tets, const Monitor* monitor, LeftoverCounts& counts,
                       std::vector<std::uint32_t>& beside);

}  // namespace geomend::hexes
