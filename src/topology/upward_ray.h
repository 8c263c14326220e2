// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/triangle_tree.h"
#include "model/brep.h"

namespace geomend::topology {

/// What lies above points: all surfaces of a model in a search tree.
class UpwardRay {
public:
    /// Polygons count as fans of their first corner. \pre brep outlives this and keeps its vertices. Cost: n log n.
    explicit UpwardRay(const BrepData& brep);

    struct Hit {
        std::uint32_t surface;
        int sign;  ///< +1 where the way up leaves through the front of the surface, else -1
    };
    /// The surfaces that the way straight up from a point passes through, once for each time; exact. A way through an edge is decided
    /// as if the point lay a little to the side, the same little for all. Nothing where the point itself lies on a surface.
    /// Cost: logarithmic, and what lies above and below the way.
    /// \param counts which surfaces are asked
    std::optional<std::vector<Hit>> above(const Vec3& point, const std::function<bool(std::uint32_t)>& counts) const;

private:
    const BrepData& brep_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> surface_;  // per triangle
    std::optional<TriangleTree> tree_;
    double top_ = 0;
};

}  // namespace geomend::topology
