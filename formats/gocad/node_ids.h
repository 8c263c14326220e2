// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/object_info.h"
#include "model/objects.h"

namespace geomend::gocad {

/// From the ids of nodes to their indices. Ids that follow each other cost nothing; ids with gaps cost four bytes
/// each in a table; ids of any kind 32 bytes each in a hash table. Memory is bounded by the number of nodes, whatever
/// the ids are.
class NodeIds {
public:
    /// \param expected number of nodes to come, at least roughly
    void expect(std::uint64_t expected) { expected_ = expected; }

    /// Adds the id of the next node. \return false when the id is there already (the node is counted, though)
    bool add(std::int64_t id) {
        const std::uint64_t offset = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_);
        if (mode_ == Mode::consecutive) [[likely]] {
            if (count_ == 0) first_ = id;
            else if (offset != count_) return leave_consecutive(), add(id);
            ++count_;
            return true;
        }
        ids_.push_back(id);
        if (mode_ == Mode::table) {
            if (offset < table_limit()) return put_in_table(offset);
            change_to_hash();
        }
        return put_in_hash(id, static_cast<std::uint32_t>(count_++));
    }

    /// The index of an id, or no_index.
    std::uint32_t find(std::int64_t id) const {
        const std::uint64_t offset = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_);
        if (mode_ == Mode::consecutive) [[likely]]
            return offset < count_ ? static_cast<std::uint32_t>(offset) : no_index;
        if (mode_ == Mode::table) return offset < table_.size() ? table_[offset] : no_index;
        return find_in_hash(id);
    }

    std::uint64_t count() const { return count_; }
    std::int64_t id_of(std::uint32_t index) const {
        return mode_ == Mode::consecutive ? first_ + static_cast<std::int64_t>(index) : ids_[index];
    }
    /// One more than the largest id.
    std::int64_t next_free() const;
    /// Moves the ids out; nothing can be found afterwards.
    Labels take_labels();

private:
    enum class Mode : std::uint8_t { consecutive, table, hash };
    struct Slot {
        std::int64_t id;
        std::uint32_t index;
    };

    std::uint64_t table_limit() const { return 4 * (expected_ > count_ ? expected_ : count_) + 1024; }
    void leave_consecutive();
    bool put_in_table(std::uint64_t offset);
    void change_to_hash();
    void grow_hash();
    bool put_in_hash(std::int64_t id, std::uint32_t index);
    std::uint32_t find_in_hash(std::int64_t id) const;

    Mode mode_ = Mode::consecutive;
    std::int64_t first_ = 0;
    std::uint64_t count_ = 0;
    std::uint64_t expected_ = 0;
    std::vector<std::int64_t> ids_;
    std::vector<std::uint32_t> table_;
    std::vector<Slot> slots_;
};

}  // namespace geomend::gocad
