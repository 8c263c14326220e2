// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/weld.h"

#include <bit>

namespace geomend::topology {

namespace {

std::uint64_t hash_of(const Vec3& p) {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const double x : p) {
        h ^= std::bit_cast<std::uint64_t>(x + 0.0);  // -0 + 0 is 0
        h *= 0xff51afd7ed558ccdu;
        h ^= h >> 32;
    }
    h *= 0xc4ceb9fe1a85ec53u;
    return h ^ (h >> 29);
}

}  // namespace

Welder::Welder(std::size_t expected) {
    positions_.reserve(expected);
    slots_.assign(std::bit_ceil(expected + expected / 2 + 16), no_index);
}

std::size_t Welder::slot_of(const Vec3& position) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(position) & mask;
    while (slots_[slot] != no_index && positions_[slots_[slot]] != position) slot = (slot + 1) & mask;
    return slot;
}

std::uint32_t Welder::add(const Vec3& position) {
    std::size_t slot = slot_of(position);
    if (slots_[slot] != no_index) return slots_[slot];
    if (positions_.size() + positions_.size() / 4 + 8 > slots_.size()) {
        grow();
        slot = slot_of(position);
    }
    const auto vertex = static_cast<std::uint32_t>(positions_.size());
    slots_[slot] = vertex;
    positions_.push_back(position);
    return vertex;
}

std::uint32_t Welder::find(const Vec3& position) const { return slots_[slot_of(position)]; }

void Welder::grow() {
    slots_.assign(slots_.size() * 2, no_index);
    for (std::size_t v = 0; v < positions_.size(); ++v) slots_[slot_of(positions_[v])] = static_cast<std::uint32_t>(v);
}

}  // namespace geomend::topology
