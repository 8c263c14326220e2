// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/node_groups.h"
#include "geometry/surface_distance.h"
#include "geometry/triangle_tree.h"

namespace geomend {

/// For the triangles of one node of a tree, those that come after them in the tree's order, are of other groups, by their boxes near
/// and share no vertex with them: nodes are gone down two at a time, and two nodes of one group are passed over.
class NearTriangles {
public:
    /// \param near of each group; only groups with the same length, more than 0, are near each other
    /// \pre all outlive this
    NearTriangles(const SurfaceDistance& soup, const NodeGroups& groups, std::span<const double> near)
        : soup_(soup), groups_(groups), near_(near) {}

    /// Looks about a node of a level, which is one of those in the groups.
    /// \param most so many pairs are enough. False where there are more: not all are there then.
    /// Cost: as the pairs whose boxes overlap
    bool collect(std::size_t level, std::size_t node, std::size_t most);

    /// The first triangle under the node, in the tree's order, and how many there are.
    std::uint32_t first() const { return first_; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(start_.size()) - 1; }
    /// Those near triangle first() + i, ascending in the tree's order.
    std::span<const std::uint32_t> at(std::size_t i) const { return std::span(others_).subspan(start_[i], start_[i + 1] - start_[i]); }

private:
    const SurfaceDistance& soup_;
    const NodeGroups& groups_;
    const std::span<const double> near_;
    std::uint32_t first_ = 0;
    std::size_t most_ = 0;
    std::vector<std::vector<FourBoxes>> wide_;  ///< the boxes under the node by level, as much wider as their groups' lengths
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    std::vector<std::size_t> start_;  ///< in others_, of each triangle, and the end
    std::vector<std::uint32_t> others_;

    void widen(std::size_t level, std::size_t node);
    void descend(std::size_t level, std::size_t local, std::size_t node, std::size_t other);
    void take(std::uint32_t t, std::uint32_t other);
    void list_by_triangle();
};

}  // namespace geomend
