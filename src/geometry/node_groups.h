// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geomend {

/// Which nodes of a TriangleTree hold triangles of one group alone, level by level as in TriangleTree::levels().
class NodeGroups {
public:
    static constexpr std::uint32_t mixed = 0xffffffff;

    /// \param groups of the triangles, in the tree's order; those in no group are `mixed`
    /// \param levels so many of the tree's, from below. Cost: linear
    NodeGroups(std::span<const std::uint32_t> groups, std::size_t levels);
    /// The group of all triangles under a node, or mixed.
    std::uint32_t at(std::size_t level, std::size_t node) const { return groups_[level][node]; }
    /// Whether all triangles under two nodes are of one group.
    bool are_one(std::size_t level, std::size_t a, std::size_t b) const { return at(level, a) != mixed && at(level, a) == at(level, b); }

private:
    std::vector<std::vector<std::uint32_t>> groups_;
};

}  // namespace geomend
