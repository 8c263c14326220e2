// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/text_cursor.h"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace geomend {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

}  // namespace

bool TextCursor::next_line() {
    if (next_ == end_) {
        at_ = line_begin_ = line_end_ = end_;
        return false;
    }
    line_begin_ = at_ = next_;
    const void* newline = std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_));
    if (newline != nullptr) {
        line_end_ = static_cast<const char*>(newline);
        next_ = line_end_ + 1;
    } else {
        line_end_ = next_ = end_;
    }
    if (line_end_ != line_begin_ && line_end_[-1] == '\r') --line_end_;
    ++line_;
    return true;
}

std::string_view TextCursor::quoted_token(bool* quoted) {
    skip_blanks();
    const bool opens = at_ != line_end_ && *at_ == '"';
    if (quoted != nullptr) *quoted = opens;
    if (!opens) return token();
    const char* begin = ++at_;
    while (at_ != line_end_ && *at_ != '"') ++at_;
    const std::string_view inside(begin, static_cast<std::size_t>(at_ - begin));
    if (at_ != line_end_) ++at_;
    return trimmed(inside);
}

std::string_view TextCursor::rest() {
    const std::string_view text = trimmed(peek_rest());
    at_ = line_end_;
    return text;
}

NumberStatus TextCursor::real(double& value) {
    skip_blanks();
    const auto [end, error] = std::from_chars(at_, line_end_, value);
    if (error == std::errc{} && (end == line_end_ || is_blank(*end))) [[likely]] {
        at_ = end;
        return NumberStatus::ok;
    }
    return parse_real(token(), value);
}

NumberStatus TextCursor::integer(std::int64_t& value) {
    skip_blanks();
    const auto [end, error] = std::from_chars(at_, line_end_, value);
    if (error == std::errc{} && (end == line_end_ || is_blank(*end))) [[likely]] {
        at_ = end;
        return NumberStatus::ok;
    }
    return parse_integer(token(), value);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\f\v";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), lower);
    return out;
}

std::string upper_case(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), upper);
    return out;
}

bool same_word(std::string_view a, std::string_view b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace geomend
