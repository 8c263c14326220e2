// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/near_features.h"

namespace geomend::arrangement {

/// The vertices that stand on edges and segments between their ends, in order from the smaller end to the larger.
class LinkTable {
public:
    /// \param on which vertex is on which link, in any order, repeats and ends allowed. Cost: sorting.
    LinkTable(std::span<const Vec3> points, std::vector<VertexOnEdge> on);

    bool empty() const { return links_.empty(); }
    /// From link.a to link.b; empty where nothing stands on it. Constant time.
    std::span<const std::uint32_t> on(const Link& link) const;
    /// False only where no link with something on it ends in the vertex.
    bool may_end_in(std::uint32_t vertex) const { return vertex < is_end_.size() && is_end_[vertex] != 0; }
    /// Adds the vertices on the way from one vertex to the other, without these, in this direction.
    void append(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& way) const;

private:
    std::vector<Link> links_;
    std::vector<std::uint32_t> first_;  // per link, and the end
    std::vector<std::uint32_t> vertices_;
    std::vector<std::uint32_t> slots_;  // open addressing: number of a link, from 1
    std::vector<std::uint8_t> is_end_;
};

}  // namespace geomend::arrangement
