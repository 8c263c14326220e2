// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace geomend::grid {

/// Finds a crossing of two edges again by its edges, each two depths. An open hash table that is emptied at the cost of
/// what it holds.
class CrossingTable {
public:
    using Edge = std::array<double, 2>;

    /// The number that goes with two edges: `fresh` where they are new. Cost: constant.
    std::uint32_t number(const Edge& first, const Edge& second, std::uint32_t fresh);
    void clear();

private:
    struct Entry {
        Edge first, second;
        std::uint32_t number;
    };
    std::size_t slot_of(const Edge& first, const Edge& second) const;
    void grow();

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> slots_;  // 1 + place in entries_, or 0
};

}  // namespace geomend::grid
