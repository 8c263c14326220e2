// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/edge_crossings.h"

#include <algorithm>
#include <bit>

namespace geomend::grid {

namespace {

std::uint64_t hash_of(const CrossingTable::Edge& first, const CrossingTable::Edge& second) {
    std::uint64_t h = 0x2545f4914f6cdd1du;
    for (const double depth : {first[0], first[1], second[0], second[1]}) {
        h ^= std::bit_cast<std::uint64_t>(depth + 0.0);  // -0 + 0 is 0
        h *= 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
    }
    return h;
}

}  // namespace

std::size_t CrossingTable::slot_of(const Edge& first, const Edge& second) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(first, second) & mask;
    while (slots_[slot] != 0) {
        const Entry& e = entries_[slots_[slot] - 1];
        if (e.first == first && e.second == second) break;
        slot = (slot + 1) & mask;
    }
    return slot;
}

std::uint32_t CrossingTable::number(const Edge& first, const Edge& second, std::uint32_t fresh) {
    if (2 * (entries_.size() + 1) > slots_.size()) grow();
    const std::size_t slot = slot_of(first, second);
    if (slots_[slot] != 0) return entries_[slots_[slot] - 1].number;
    entries_.push_back({first, second, fresh});
    slots_[slot] = static_cast<std::uint32_t>(entries_.size());
    return fresh;
}

void CrossingTable::clear() {
    if (entries_.empty()) return;
    entries_.clear();
    std::ranges::fill(slots_, 0u);
}

void CrossingTable::grow() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), 0);
    for (std::size_t e = 0; e < entries_.size(); ++e)
        slots_[slot_of(entries_[e].first, entries_[e].second)] = static_cast<std::uint32_t>(e + 1);
}

}  // namespace geomend::grid
