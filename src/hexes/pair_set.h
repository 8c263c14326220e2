// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace geomend::hexes {

/// Two vertices in either order as one number.
inline std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    return (std::uint64_t{a} << 32) | b;
}

/// Pairs of vertices. Looking one up costs little where one of the two is in no pair, and the logarithm of their number else.
class PairSet {
public:
    PairSet() = default;
    /// \param keys of pair_key(), in any order, also more than once
    explicit PairSet(std::vector<std::uint64_t> keys, std::size_t vertices) : keys_(std::move(keys)), is_in_(vertices, 0) {
        std::ranges::sort(keys_);
        keys_.erase(std::ranges::unique(keys_).begin(), keys_.end());
        for (const std::uint64_t key : keys_) is_in_[key >> 32] = is_in_[key & 0xffffffffu] = 1;
    }
    bool has(std::uint32_t a, std::uint32_t b) const {
        return !keys_.empty() && is_in_[a] != 0 && is_in_[b] != 0 && std::ranges::binary_search(keys_, pair_key(a, b));
    }
    /// Whether a vertex is in some pair.
    bool has(std::uint32_t vertex) const { return !keys_.empty() && is_in_[vertex] != 0; }

private:
    std::vector<std::uint64_t> keys_;
    std::vector<std::uint8_t> is_in_;
};

}  // namespace geomend::hexes
