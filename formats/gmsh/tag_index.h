// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "model/objects.h"

namespace geomend::gmsh {

/// From the file's tags of nodes or elements to our indices. Nothing is stored for tags that run one after the
/// other, a table for tags that nearly do, a sorted list for scattered ones.
class TagIndex {
public:
    /// Takes over the tags; those that run first, first+1, ... leave `labels.ids` empty.
    /// Returns the index of a tag that was there before, if any. Cost: linear, or sorting for scattered tags.
    std::optional<std::size_t> build(Labels& labels, std::size_t count);

    /// The index of a tag, or no_index.
    std::uint32_t find(std::int64_t tag) const {
        const std::uint64_t at = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_);
        if (at < run_) return static_cast<std::uint32_t>(at);
        if (at < table_.size()) return table_[at];
        return sorted_.empty() ? no_index : search(tag);
    }

private:
    std::uint32_t search(std::int64_t tag) const;

    std::int64_t first_ = 0;
    std::uint64_t run_ = 0;
    std::vector<std::uint32_t> table_;
    std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;
};

}  // namespace geomend::gmsh
