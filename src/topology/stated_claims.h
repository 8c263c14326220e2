// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/brep.h"

namespace geomend::topology {

/// What a file states of the sides of regions, as far as judges compare it with the geometry.
struct StatedClaims {
    /// A region with surfaces on whose other side it lies.
    struct WrongSides {
        std::string name;
        std::int64_t region = -1;  ///< its number in the B-Rep; -1: the Universe
        std::vector<SurfaceId> turned;
        double volume_as_stated = 0, volume = 0;
    };
    std::vector<WrongSides> wrong_sides;
    bool reversed_convention = false;  ///< throughout the file a sign means the other side
    bool universe_stated = false;
    std::string universe_name;
    std::vector<BrepData::Side> universe;  ///< as stated, turned to what the geometry shows
};

}  // namespace geomend::topology
