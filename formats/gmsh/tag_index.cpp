// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/tag_index.h"

#include <algorithm>

namespace geomend::gmsh {

std::optional<std::size_t> TagIndex::build(Labels& labels, std::size_t count) {
    table_.clear();
    sorted_.clear();
    run_ = 0;
    first_ = labels[0];
    if (count == 0) return {};
    std::vector<std::int64_t>& ids = labels.ids;
    bool consecutive = true;
    for (std::size_t i = 0; consecutive && i < ids.size(); ++i)
        consecutive = static_cast<std::uint64_t>(ids[i]) - static_cast<std::uint64_t>(ids[0]) == i;
    if (consecutive) {
        labels.first = first_;
        ids = {};
        run_ = count;
        return {};
    }
    const auto [low, high] = std::ranges::minmax(ids);
    const std::uint64_t range = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
    if (range < 4 * std::uint64_t{count} + 1024) {
        first_ = low;
        table_.assign(range + 1, no_index);
        for (std::size_t i = 0; i < count; ++i) {
            std::uint32_t& slot = table_[static_cast<std::uint64_t>(ids[i]) - static_cast<std::uint64_t>(low)];
            if (slot != no_index) return i;
            slot = static_cast<std::uint32_t>(i);
        }
        return {};
    }
    sorted_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) sorted_.emplace_back(ids[i], static_cast<std::uint32_t>(i));
    std::ranges::sort(sorted_);
    const auto twice = std::ranges::adjacent_find(sorted_, {}, &std::pair<std::int64_t, std::uint32_t>::first);
    if (twice != sorted_.end()) return std::next(twice)->second;
    return {};
}

std::uint32_t TagIndex::search(std::int64_t tag) const {
    const auto at = std::ranges::lower_bound(sorted_, tag, {}, &std::pair<std::int64_t, std::uint32_t>::first);
    return at != sorted_.end() && at->first == tag ? at->second : no_index;
}

}  // namespace geomend::gmsh
