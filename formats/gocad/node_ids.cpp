// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/node_ids.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace geomend::gocad {

namespace {

// The finaliser of splitmix64: ids that come in patterns spread evenly.
std::uint64_t mix(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

}  // namespace

void NodeIds::leave_consecutive() {
    ids_.reserve(std::max(expected_, count_ + 1));
    for (std::uint64_t i = 0; i != count_; ++i) ids_.push_back(first_ + static_cast<std::int64_t>(i));
    table_.reserve(std::max(expected_, count_ + 1));
    for (std::uint64_t i = 0; i != count_; ++i) table_.push_back(static_cast<std::uint32_t>(i));
    mode_ = Mode::table;
}

bool NodeIds::put_in_table(std::uint64_t offset) {
    if (offset >= table_.size()) table_.resize(offset + 1, no_index);
    const bool is_new = table_[offset] == no_index;
    if (is_new) table_[offset] = static_cast<std::uint32_t>(count_);
    ++count_;
    return is_new;
}

void NodeIds::change_to_hash() {
    mode_ = Mode::hash;
    std::vector<std::uint32_t>().swap(table_);
    std::size_t size = 64;
    while (size < 2 * std::max(expected_, count_ + 1)) size *= 2;
    slots_.assign(size, {0, no_index});
    for (std::uint64_t i = 0; i != count_; ++i) put_in_hash(ids_[i], static_cast<std::uint32_t>(i));
}

void NodeIds::grow_hash() {
    std::vector<Slot> old(2 * slots_.size(), {0, no_index});
    old.swap(slots_);
    for (const Slot& slot : old) {
        if (slot.index != no_index) put_in_hash(slot.id, slot.index);
    }
}

bool NodeIds::put_in_hash(std::int64_t id, std::uint32_t index) {
    if (2 * static_cast<std::size_t>(index) >= slots_.size()) grow_hash();
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = mix(static_cast<std::uint64_t>(id)) & mask;
    while (slots_[at].index != no_index) {
        if (slots_[at].id == id) return false;
        at = (at + 1) & mask;
    }
    slots_[at] = {id, index};
    return true;
}

std::uint32_t NodeIds::find_in_hash(std::int64_t id) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = mix(static_cast<std::uint64_t>(id)) & mask;
    while (slots_[at].index != no_index) {
        if (slots_[at].id == id) return slots_[at].index;
        at = (at + 1) & mask;
    }
    return no_index;
}

std::int64_t NodeIds::next_free() const {
    std::int64_t largest = first_ + static_cast<std::int64_t>(count_) - 1;
    if (mode_ != Mode::consecutive && !ids_.empty()) largest = *std::ranges::max_element(ids_);
    return largest == std::numeric_limits<std::int64_t>::max() ? largest : largest + 1;
}

Labels NodeIds::take_labels() {
    Labels labels;
    labels.first = count_ == 0 ? 1 : first_;
    labels.ids = std::move(ids_);
    *this = {};
    return labels;
}

}  // namespace geomend::gocad
