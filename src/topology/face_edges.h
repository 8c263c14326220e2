// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/brep.h"

namespace geomend::topology {

/// The edges of a surface's polygons, numbered by the corner at which they start.
class PolygonEdges {
public:
    explicit PolygonEdges(const Polygons& polygons);

    std::uint32_t polygon(std::size_t corner) const {
        return polygon_of_.empty() ? static_cast<std::uint32_t>(corner / 3) : polygon_of_[corner];
    }
    /// The corner at which the edge from `corner` ends.
    std::uint32_t next(std::size_t corner) const {
        if (polygon_of_.empty()) return static_cast<std::uint32_t>(corner % 3 == 2 ? corner - 2 : corner + 1);
        const std::uint32_t p = polygon_of_[corner];
        return static_cast<std::uint32_t>(corner + 1 == polygons_->offsets[p + 1] ? polygons_->offsets[p] : corner + 1);
    }
    std::uint32_t start_node(std::size_t corner) const { return polygons_->corners[corner]; }
    std::uint32_t end_node(std::size_t corner) const { return polygons_->corners[next(corner)]; }

private:
    const Polygons* polygons_;
    std::vector<std::uint32_t> polygon_of_;  // empty when all are triangles
};

/// The model vertex of a polygon that lies farthest from the line through a and b, an edge of it: the polygon leaves the
/// edge towards it. Linear in the polygon's corners.
VertexId far_vertex(const BrepData& brep, const BrepData::Surface& surface, std::uint32_t polygon, const Vec3& a, const Vec3& b);

/// What connect_polygons found.
struct FaceEdges {
    std::vector<std::uint32_t> border;      ///< corners that start an edge on the border, or one that more than two polygons share
    std::vector<std::uint32_t> degenerate;  ///< polygons that use a node twice
    std::vector<std::uint32_t> duplicate;   ///< polygons with the nodes of an earlier one
};

/// Fills surface.neighbours: two polygons are neighbours across an edge when exactly they use its two nodes. Degenerate
/// polygons and repeats of an earlier polygon have neither neighbours nor borders. Cost: linear.
FaceEdges connect_polygons(BrepData::Surface& surface);

}  // namespace geomend::topology
