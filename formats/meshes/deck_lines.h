// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text_cursor.h"

namespace geomend::meshes {

/// A keyword line of an input deck of Abaqus: its word in upper case without the '*', and its parameters with names in upper case.
struct DeckKeyword {
    std::string word;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::uint64_t line = 0;

    /// The value of a parameter; empty where it is not there or has none.
    std::string_view value(std::string_view name) const;
    bool has(std::string_view name) const;
};

/// Walks over a deck line by line: keyword lines, lines of data in between; comments ("**") and empty lines are passed over.
class DeckLines {
public:
    explicit DeckLines(std::string_view text);

    enum class Kind : std::uint8_t { end, keyword, data };
    Kind next();
    /// Of the line that next() came to. \pre it was one of that kind
    const DeckKeyword& keyword() const { return keyword_; }
    /// Fields between commas, without blanks around them; a comma at the end adds none.
    const std::vector<std::string_view>& fields() const { return fields_; }
    std::uint64_t line() const { return cursor_.line(); }
    const TextCursor& cursor() const { return cursor_; }

private:
    TextCursor cursor_;
    DeckKeyword keyword_;
    std::vector<std::string_view> fields_;

    void split(std::string_view text);
    void read_keyword();
};

}  // namespace geomend::meshes
