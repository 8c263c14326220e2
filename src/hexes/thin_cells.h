// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "hexes/candidates.h"
#include "hexes/closing.h"

namespace geomend::hexes {

/// What the triangles of surfaces become that bound a part of a region which is thin for its size: one without vertices inside. Each is a
/// facet of one cell between that surface and the next one, its dual in the sense of the source; sides of a triangle count one by one.
struct ThinCounts {
    std::uint64_t triangles = 0;   ///< sides of triangles in thin parts
    std::uint64_t prisms = 0;      ///< with six corners: three on each surface
    std::uint64_t pyramids = 0;    ///< with five: the surfaces meet in one of them
    std::uint64_t tetrahedra = 0;  ///< with four: they meet in two
    std::uint64_t ignored = 0;     ///< with three: both surfaces have this triangle
    // Those that are no cells; tetrahedra fill them.
    std::uint64_t undefined = 0;  ///< a corner has no counterpart on another surface
    std::uint64_t unmatched = 0;  ///< the counterparts are no triangle of a surface
    std::uint64_t invalid = 0;    ///< folded or of a bad shape, or an edge inside or another cell is in the way
};

/// Prisms and pyramids between the surfaces of parts that are thin for their size: both ends of a prism are triangles of surfaces, and
/// two triangles of a pyramid that share its apex. Source: J. Pellerin (2014), 5.3.2: the segments of Voronoi edges between two surfaces
/// have these duals; 5.4 for those that are no cells.
/// Cost: as of find_prisms() for the tetrahedra of thin parts.
Candidates thin_cells(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options);

/// What became of the triangles in a mesh made of these tetrahedra. Cost: n log n in triangles.
ThinCounts count_thin(const TetMesh& mesh, const MixedMesh& made);

}  // namespace geomend::hexes
