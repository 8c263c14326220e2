// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "hexes/closing.h"

namespace geomend::hexes {

/// Which vertices have to stay where they are: those on walls and on lines.
std::vector<std::uint8_t> fixed_vertices(const TetMesh& mesh);

/// Moves vertices inside of regions towards the middle of their neighbours, or a part of the way, where the worst cell around becomes
/// better by it (scaled_jacobian()), none becomes folded, and no hexahedron falls below a quality; then to where the hexahedra around are
/// larger, where the worst cell becomes no worse by that. One after the other, several times.
/// \param fixed per vertex of the tetrahedra; new ones may move
/// \return how many moves were made. Cost: 50 microseconds for a vertex and pass.
std::uint64_t smooth(MixedMesh& mesh, const std::vector<std::uint8_t>& fixed, double least_hexahedron, int passes);

}  // namespace geomend::hexes
