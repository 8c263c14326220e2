// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/input.h"
#include "base/monitor.h"
#include "base/result.h"

// A ROFF file is a sequence of tags, each with named values and arrays. The text form has numbers in columns and text
// between double quotes; the binary one has raw numbers and tokens that end with a zero byte.

namespace geomend::roff {

enum class ValueType : std::uint8_t { integer, real, real_double, boolean, byte, text };

/// "int", "float", ...
const char* type_word(ValueType type);

/// A value or an array: what it is, and where its values stand.
struct Entry {
    std::string name;
    ValueType type = ValueType::integer;
    bool array = false;
    std::uint64_t count = 1;
    std::uint64_t place = 0;           ///< offset of its type
    std::uint64_t begin = 0, end = 0;  ///< offsets of its values
};

struct Tag {
    std::string name;
    std::uint64_t place = 0;
    std::vector<Entry> entries;
};

/// A file whose tags are known; values are read on demand.
struct Document {
    Input input;
    bool text = false;
    bool swapped = false;  ///< binary: the bytes of numbers are in the other order than the machine's
    std::vector<Tag> tags;
};

/// Finds all tags. Counts are bounded by the bytes that could hold them.
/// Errors: F003 no such file, F004 cut short, F012 malformed, F014 counts.
Result<Document> find_tags(const Input& input, const Monitor* monitor);

/// Line and column, or the offset, of a byte.
Location place_at(const Document& document, std::uint64_t offset);

/// The entry with a name, or nullptr.
const Entry* find_entry(const Tag& tag, std::string_view name);
/// The first tag with a name, or nullptr.
const Tag* find_tag(const Document& document, std::string_view name);

// Values of an entry, of whatever type where that loses nothing. Errors: F005, F012 with the place.

Result<std::vector<std::int32_t>> integers(const Document& document, const Entry& entry);
Result<std::vector<float>> floats(const Document& document, const Entry& entry);
Result<std::vector<double>> doubles(const Document& document, const Entry& entry);
Result<std::vector<std::uint8_t>> bytes(const Document& document, const Entry& entry);
Result<std::vector<std::string>> texts(const Document& document, const Entry& entry);

}  // namespace geomend::roff
