// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/dataset.h"

namespace geomend::test {

/// How patches of a made model end at what they should end on.
enum class Ending : std::uint8_t { exact, out_of_box, through_faults, short_of };

/// Planar faults in a box and, in each block between them, planar horizons shifted by a throw: loose surfaces with triangles
/// of their own, and what is right: the volume of each region of the arrangement of half-spaces, ascending.
struct FaultBlocks {
    Dataset dataset;
    std::vector<double> volumes;
    double size = 0;  ///< longest side of the box
    double max_gap = -1;
};

/// The model of a seed; one without regions too small to tell. The same for the same arguments.
/// Sides of the box: 10 x 8 x 4 or a hundred times that, at the origin or in map coordinates.
/// \param lowest_moved the lowest horizon of every block is elsewhere by this in the volumes, not in the surfaces
FaultBlocks fault_blocks(std::uint32_t seed, Ending ending, const Vec3& lowest_moved = {0, 0, 0});

/// Puts the triangles of all surfaces in another order, points, too. Nothing else changes.
void shuffle(Dataset& dataset, std::uint32_t seed);

}  // namespace geomend::test
