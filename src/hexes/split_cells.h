// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hexes/closing.h"

namespace geomend::hexes {

/// A quadrangle of a cell that has two triangles behind it.
struct OpenQuad {
    std::uint32_t cell, face;
    std::uint32_t start;  ///< the face's corner, 0 or 1, at which the diagonal between the triangles begins
};

/// A place of a facet while cells may still be split: the half of a quadrangle is 0 with the corners after the start, or 1.
constexpr std::uint32_t half_face(std::uint32_t face, std::uint32_t half) { return 2 * face + half; }

/// The local face of a tetrahedron that does not have its corner k.
std::uint32_t face_opposite(std::uint32_t k);

/// Splits the cells that have an open quadrangle: a hexahedron into six pyramids about its middle, a prism into three and two
/// tetrahedra; where the quadrangle is open two tetrahedra stand in the place of the pyramid. A pyramid becomes two tetrahedra.
/// Places of facets have faces by half_face() before and after. \return how many were split. Linear.
std::uint64_t split_cells(MixedMesh& mesh, std::span<const OpenQuad> open);

}  // namespace geomend::hexes
