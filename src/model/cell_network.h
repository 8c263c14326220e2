// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace geomend {

/// A mesh as simulators of flow see it: cells with a volume, and connections through the faces that they share.
struct CellNetwork {
    std::vector<double> volumes;  ///< per cell, more than 0 where it is the right way out
    std::vector<Vec3> centres;    ///< per cell, centre of mass
    struct Connection {
        std::uint32_t from, to;            ///< cells, from < to
        std::uint32_t from_face, to_face;  ///< the face as a local face of each of them
        Vec3 area;                         ///< area vector of the face, from `from` to `to`
        Vec3 centre;                       ///< of the face
    };
    std::vector<Connection> connections;  ///< ascending by from, then to

    bool empty() const { return volumes.empty(); }
};

}  // namespace geomend
