// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "topology/used_points.h"

namespace geomend::topology {

/// Where a part lies, and how large it is.
struct PartExtent {
    double weight = 0;  ///< area, or volume of cells
    Vec3 centroid{};    ///< weighted; of parts without weight the mean of the vertices
    double radius = 0;  ///< largest distance of a vertex from the centroid
    Vec3 low{}, high{};
    /// Along each axis the largest coordinate as it is stored, of objects in double and in single precision; negative: none.
    Vec3 largest_double{-1, -1, -1}, largest_single{-1, -1, -1};
    bool empty = true;  ///< nothing of it counts
};

/// Of each part; triangles with a vertex that is left out do not count. Cost: linear, in parallel.
/// \param left_out per vertex; not 0: it takes no part
std::vector<PartExtent> part_extents(const Dataset& dataset, const UsedPoints& used, const HangingParts& parts,
                                     std::span<const std::uint8_t> left_out);

/// Along each axis four steps of the precision in which the coordinates of a part are stored.
Vec3 stored_steps(const PartExtent& part);

/// The cluster of each part, numbered from 0 in the order of their first parts: parts that come closer to each other than a
/// hundredth of the larger one's diameter (twice the radius) are in one, as are a part and what lies inside of it, and so is what a
/// chain of such parts links. The measures are the distance of triangles, which does not change when a model is turned, and whether
/// all six ways along the axes from one part meet the other.
/// Cost: near-linear; as the number of triangles that lie near the bounds of other parts, times a search for each.
std::vector<std::uint32_t> cluster_parts(const UsedPoints& used, const HangingParts& parts, std::span<const PartExtent> extents,
                                         std::span<const std::uint8_t> left_out);

}  // namespace geomend::topology
