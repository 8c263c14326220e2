// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/scanner.h"

#include <algorithm>
#include <charconv>

#include "base/wording.h"

namespace geomend::gmsh {

Location Scanner::location(const char* where) const {
    const char* begin = input_->bytes().data();
    Location l;
    l.file = input_->name();
    l.offset = where - begin;
    if (encoding_.binary) return l;
    l.line = 1 + static_cast<std::uint64_t>(std::count(begin, where, '\n'));
    const char* line_begin = where;
    while (line_begin != begin && line_begin[-1] != '\n') --line_begin;
    l.column = static_cast<std::uint32_t>(where - line_begin + 1);
    return l;
}

void Scanner::fail(const char* code, std::string message, const char* where) {
    if (failed_) return;
    failed_ = true;
    failure_ = unreadable(code, location(where != nullptr ? where : at_), "section $" + std::string(name_) + ": " + std::move(message));
    at_ = end_;
}

void Scanner::cut(const char* what) {
    fail("F008", std::string("expected ") + what + ", but the section ends here: it holds less than its counts say");
}

std::string_view Scanner::next_word() const {
    const char* p = at_;
    while (p != end_ && !is_space(*p)) ++p;
    return {at_, static_cast<std::size_t>(p - at_)};
}

std::int64_t Scanner::slow_integer(const char* what) {
    if (failed_) return 0;
    if (at_ == end_) {
        cut(what);
        return 0;
    }
    const std::string_view word = next_word();
    std::int64_t value = 0;
    const NumberStatus status = parse_integer(word, value);
    if (status == NumberStatus::ok) {
        at_ += word.size();
        return value;
    }
    if (status == NumberStatus::out_of_range) {
        fail("F005", std::string("expected ") + what + ", found " + quoted_start(word) + ", which is too large for an integer");
    } else {
        fail("F005", std::string("expected ") + what + " (an integer), found " + quoted_start(word));
    }
    return 0;
}

double Scanner::text_real(const char* what) {
    skip_space();
    double value = 0;
    const auto [stop, error] = std::from_chars(at_, end_, value);
    if (error == std::errc{} && (stop == end_ || is_space(*stop))) [[likely]] {
        at_ = stop;
        return value;
    }
    if (failed_) return 0;
    if (at_ == end_) {
        cut(what);
        return 0;
    }
    const std::string_view word = next_word();
    if (parse_real(word, value) == NumberStatus::ok) {
        at_ += word.size();
        return value;
    }
    fail("F005", std::string("expected ") + what + " (a number), found " + quoted_start(word));
    return 0;
}

bool Scanner::fits(std::int64_t n, const char* what, std::uint64_t least_bytes, std::uint64_t least_numbers) {
    if (failed_) return false;
    if (n < 0) {
        fail("F008", std::string("the ") + what + " is negative: " + std::to_string(n));
        return false;
    }
    // A number of a text takes a digit and a blank; the last one may do without the blank.
    const std::uint64_t each = std::max<std::uint64_t>(1, encoding_.binary ? least_bytes : 2 * least_numbers);
    const std::uint64_t most = (left() + 1) / each;
    if (static_cast<std::uint64_t>(n) > most) {
        fail("F014", std::string("the ") + what + " is " + std::to_string(n) + ", but the " + std::to_string(left()) +
                         " bytes that are left of the section hold " + std::to_string(most) + " at most");
        return false;
    }
    return true;
}

std::uint64_t Scanner::count(const char* what, std::uint64_t least_bytes, std::uint64_t least_numbers) {
    const char* before = at_;
    const std::int64_t n = size(what);
    if (failed_) return 0;
    if (!fits(n, what, least_bytes, least_numbers)) {
        failure_.error.where = location(before);
        return 0;
    }
    return static_cast<std::uint64_t>(n);
}

std::string_view Scanner::line() {
    const char* begin = at_;
    const void* newline = left() == 0 ? nullptr : std::memchr(at_, '\n', left());
    const char* stop = newline != nullptr ? static_cast<const char*>(newline) : end_;
    at_ = newline != nullptr ? stop + 1 : end_;
    if (stop != begin && stop[-1] == '\r') --stop;
    return {begin, static_cast<std::size_t>(stop - begin)};
}

bool Scanner::at_end() {
    skip_space();
    return at_ == end_;
}

void Scanner::expect_end() {
    if (failed_ || at_end()) return;
    if (encoding_.binary)
        fail("F008", std::to_string(left()) + " bytes are left after the last record: the section holds more than its counts say");
    else fail("F008", "found " + quoted_start(next_word()) + " after the last record: the section holds more than its counts say");
}

}  // namespace geomend::gmsh
