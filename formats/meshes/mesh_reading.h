// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/input.h"
#include "base/text_cursor.h"
#include "formats/byte_order_mark.h"
#include "formats/format.h"
#include "model/dataset.h"

namespace geomend::meshes {

/// The words of a text, whatever lines they stand on; what follows a '#' on a line is a comment.
class Words {
public:
    explicit Words(std::string_view text) : cursor_(without_byte_order_mark(text)) {}

    /// The next word; empty at the end of the text. Comments that are passed are kept in comment() until the next call.
    std::string_view next();
    /// The next word without taking it.
    std::string_view peek();
    std::uint64_t line() const { return cursor_.line(); }
    const TextCursor& cursor() const { return cursor_; }

    /// What numbers of entities are called, where comments of our own say it: "# region 3: Upper".
    const std::map<std::pair<std::string, std::int64_t>, std::string>& names() const { return names_; }

private:
    TextCursor cursor_;
    std::optional<std::string_view> peeked_;
    std::map<std::pair<std::string, std::int64_t>, std::string> names_;

    std::string_view take();
    void note(std::string_view comment);
};

/// A mesh that grows while it is read: cells by the number or name of what they belong to.
class GrowingMesh {
public:
    CellMesh mesh;

    /// The entity of a dimension with a number; made where it is not there.
    std::uint32_t entity(int dimension, std::int64_t tag, const std::string& name);
    void add(CellType type, std::span<const std::uint32_t> nodes, std::uint32_t entity);
    /// Drops entities where none of the cells has a number but 0, so that a mesh without regions has none. A surface that lies between
    /// several pairs of regions becomes one entity for each, in a group with its name and number.
    void finish();

private:
    std::map<std::pair<int, std::int64_t>, std::uint32_t> entity_of_;

    void cut_surfaces();
};

/// The next word as a whole number, or the failure that says what was expected (F004 at the end of the text, F005).
std::optional<Failure> whole_number(const Input& input, Words& words, std::string_view what, std::int64_t& value);
/// The same for a finite real number (F004, F005, F006).
std::optional<Failure> real_number(const Input& input, Words& words, std::string_view what, double& value);

}  // namespace geomend::meshes
