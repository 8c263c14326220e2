// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "arrangement/near_features.h"
#include "arrangement/spaced_points.h"

namespace geomend::arrangement {

/// One triangulation of triangles in a plane, and which of them cover each of its triangles.
struct PlanarCut {
    std::vector<Triangle> triangles;   ///< all turn the same way
    std::vector<std::uint32_t> first;  ///< per triangle the begin of its covers, and the end
    struct Cover {
        std::uint32_t whole;  ///< which of the triangles that were cut
        bool turned;          ///< it faces the other way
    };
    std::vector<Cover> covers;
};

/// Cuts triangles of one plane along the edges of all: segments only are cut against each other, until nothing is found any more, and
/// the plane is triangulated between them once, so that no diagonal is ever cut. Points come in that keep their distance.
/// \pre points of the triangles lie in a plane, but for rounding
/// \param normal of the plane \param reach within which points are parts of segments
/// Nothing where segments keep crossing, or the triangles are flat. Cost: about the pairs of segments that overlap along one axis.
std::optional<PlanarCut> cut_in_plane(SpacedPoints& points, std::span<const Triangle> wholes, const Vec3& normal, double reach);

}  // namespace geomend::arrangement
