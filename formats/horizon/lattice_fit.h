// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "formats/horizon/lattice.h"

namespace geomend::horizon {

/// A raster's lattice in the terms of a file, and which sample of the raster stands where.
struct LatticeFit {
    GridFrame frame;
    std::array<std::uint32_t, 2> first{};  ///< raster indices of the frame's sample (0, 0)
    bool transposed = false;               ///< the frame's i runs along the raster's j
    std::array<int, 2> direction{1, 1};    ///< of the frame's i and j along the raster's indices
    double moved = 0;                      ///< largest distance between a corner and where the frame puts it
    double tolerance = 0;                  ///< four units in the last place of the largest coordinate

    /// Index of the raster's sample for the frame's (i, j).
    std::size_t sample(const Raster& raster, std::uint32_t i, std::uint32_t j) const;
};

/// The lattice in the terms of a file; nothing, and `why`, when its form does not allow it.
std::optional<LatticeFit> fit_lattice(const Raster& raster, bool rotation_allowed, std::string& why);

/// Distance that the corners of a frame move when it is replaced by another.
double corner_distance(const GridFrame& a, const GridFrame& b);

}  // namespace geomend::horizon
