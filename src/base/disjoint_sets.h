// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace geomend {

/// The numbers 0..size-1 in sets that are joined two at a time. The root of a set is its smallest member, so that
/// the result does not depend on the order of joining. Nearly constant time an operation (path halving).
class DisjointSets {
public:
    explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

    std::size_t size() const { return parent_.size(); }
    /// \pre i < size()
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// Makes one set of those that hold a and b. \pre a, b < size()
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a < b) parent_[b] = a;
        else parent_[a] = b;
    }
    /// The root of each number. Linear.
    std::vector<std::uint32_t> roots() && {
        for (std::uint32_t& parent : parent_) parent = parent_[parent];  // roots come first
        return std::move(parent_);
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace geomend
