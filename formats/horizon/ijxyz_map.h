// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>

#include "model/objects.h"

namespace geomend::horizon {

/// A sample of a map by the numbers of its lines.
struct LineSample {
    std::int64_t i = 0, j = 0;
    Vec3 position{};  ///< elevation-up
};

struct LatticeMap {
    Raster raster;
    double moved = 0;  ///< largest distance between a sample in the file and where the lattice has it, in the plane
};

/// The raster on whose lattice all samples stand, to a hundredth of its smaller step; those that are not in the file are missing.
/// Nothing, and `why`, where there is none. Linear, but for sorting.
std::optional<LatticeMap> lattice_of_samples(std::span<const LineSample> samples, std::string& why);

}  // namespace geomend::horizon
