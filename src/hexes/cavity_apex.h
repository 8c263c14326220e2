// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "hexes/half_spaces.h"
#include "hexes/open_diagonal.h"

namespace geomend::hexes {

/// The border of a part of space that cells around one new vertex are to fill; all faces are wound so that their normals point into it.
struct CavityBorder {
    std::vector<std::array<Vec3, 4>> quads;      ///< those below pyramids
    std::vector<std::array<Vec3, 3>> triangles;  ///< those below tetrahedra
    std::span<const HalfSpace> also = {};        ///< as in Fan
};

/// How far in front of all faces the best place is, over the size of the border; it is not positive where there is no place that sees all
/// of them. The triangles that keep it from being more are in the way of something better.
struct Room {
    double depth;
    std::vector<std::uint32_t> in_the_way;  ///< triangles, by their number; quadrangles are not among them
};
Room room_in(const CavityBorder& border);

/// A place for a vertex from which all faces are seen, with the worst of the cells as good as was found. Its quality is not positive
/// where there is none. Cost: as deepest_place() for four times the quadrangles and the triangles, and some microseconds a face.
ApexPlace place_for_apex(const CavityBorder& border);

}  // namespace geomend::hexes
