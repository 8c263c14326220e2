// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/finding.h"
#include "base/number_text.h"

namespace geomend {

/// Walks over a text line by line and token by token, without copying. Lines end with LF, CRLF or a lone
/// CR at the very end; tokens are separated by blanks and tabs. It keeps the line number for messages.
///
/// Start: before the first line. Call next_line() and then take tokens until one comes back empty.
class TextCursor {
public:
    TextCursor() = default;
    /// \param text stays alive as long as the cursor
    /// \param first_line number of the first line, for parts of a file
    explicit TextCursor(std::string_view text, std::uint64_t first_line = 1)
        : next_(text.data()), end_(text.data() + text.size()), at_(next_), line_end_(next_), line_begin_(next_), line_(first_line - 1) {}

    /// Goes to the next line; false at the end of the text. A last line without a line end counts.
    bool next_line();

    /// The next token of this line; empty at its end.
    std::string_view token() {
        skip_blanks();
        const char* begin = at_;
        while (at_ != line_end_ && !is_blank(*at_)) ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    /// Like token(), but "a name" in double quotes is one token; the quotes and blanks just inside them are
    /// dropped. `quoted` (optional) tells an empty quoted name from the end of the line. An unclosed quote
    /// runs to the end of the line.
    std::string_view quoted_token(bool* quoted = nullptr);

    /// What is left of this line, without blanks at either end; takes it all.
    std::string_view rest();
    /// What is left of this line, untouched and not taken.
    std::string_view peek_rest() const { return {at_, static_cast<std::size_t>(line_end_ - at_)}; }
    /// The whole line, as it stands (without its line end).
    std::string_view line_text() const { return {line_begin_, static_cast<std::size_t>(line_end_ - line_begin_)}; }
    /// True when only blanks are left on this line.
    bool at_line_end() {
        skip_blanks();
        return at_ == line_end_;
    }
    /// Goes back to the start of the line.
    void rewind_line() { at_ = line_begin_; }

    /// The next token as a real number or an integer; malformed where there is none. On anything but ok
    /// the cursor stands after the token.
    NumberStatus real(double& value);
    NumberStatus integer(std::int64_t& value);

    std::uint64_t line() const { return line_; }
    /// Column of the next character, from 1.
    std::uint32_t column() const { return static_cast<std::uint32_t>(at_ - line_begin_ + 1); }
    /// First byte after this line (and its line end).
    const char* next_line_begin() const { return next_; }
    const char* text_end() const { return end_; }
    /// Goes on at a byte further on, as `line` (the line that starts there); next_line() then gives it.
    void jump(const char* to, std::uint64_t line) {
        next_ = to;
        at_ = line_begin_ = line_end_ = to;
        line_ = line - 1;
    }

private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
    void skip_blanks() {
        while (at_ != line_end_ && is_blank(*at_)) ++at_;
    }

    const char* next_ = nullptr;
    const char* end_ = nullptr;
    const char* at_ = nullptr;
    const char* line_end_ = nullptr;
    const char* line_begin_ = nullptr;
    std::uint64_t line_ = 0;
};

/// Without blanks, tabs and CR at either end.
std::string_view trimmed(std::string_view text);
/// ASCII only.
std::string lower_case(std::string_view text);
std::string upper_case(std::string_view text);
/// Equal but for ASCII case.
bool same_word(std::string_view a, std::string_view b);

}  // namespace geomend
