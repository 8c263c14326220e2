// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/number_text.h"
#include "base/output.h"
#include "base/parallel.h"

namespace geomend::grdecl {

/// What one element of an array is written as: a value, or a default (N*).
template <class T>
struct Element {
    T value{};
    bool given = true;

    bool same(const Element& other) const {
        if (given != other.given) return false;
        if (!given) return true;
        if constexpr (std::is_same_v<T, double>) return std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(other.value);
        else if constexpr (std::is_same_v<T, float>)
            return std::bit_cast<std::uint32_t>(value) == std::bit_cast<std::uint32_t>(other.value);
        else return value == other.value;
    }
};

/// Items in lines of at most 128 characters, the classic limit of simulators.
class Lines {
public:
    void clear() { end_ = column_ = 0; }
    void put(std::string_view item) {
        char* to = room(item.size() + 2);
        if (column_ + 1 + item.size() > widest) {
            *to++ = '\n';
            ++end_;
            column_ = 0;
        }
        *to = ' ';
        std::memcpy(to + 1, item.data(), item.size());
        take(1 + item.size());
    }
    /// Puts a finite number where it will stand, which saves copying it. False, and nothing is put, where the line may be full.
    template <class Number>
    bool put_number(Number value) {
        if (column_ + 1 + longest_number > widest) return false;
        char* to = room(1 + longest_number);
        *to = ' ';
        take(static_cast<std::size_t>(std::to_chars(to + 1, to + 1 + longest_number, value).ptr - to));
        return true;
    }
    void end() {
        if (column_ > 0) *room(1) = '\n', ++end_;
        column_ = 0;
    }
    std::string_view view() const { return std::string_view(text_).substr(0, end_); }
    /// An empty text to make an item in, without an allocation for each.
    std::string& scratch() {
        scratch_.clear();
        return scratch_;
    }

private:
    static constexpr std::size_t widest = 128, longest_number = 24;
    std::string scratch_;
    std::string text_;  // what was put ends at end_
    std::size_t end_ = 0, column_ = 0;

    char* room(std::size_t count) {
        if (text_.size() - end_ < count) text_.resize(2 * text_.size() + count + 4096);
        return text_.data() + end_;
    }
    void take(std::size_t count) {
        end_ += count;
        column_ += count;
    }
};

/// Puts count times the same element: "v", "N*v" or "N*". Numbers are the shortest digits that read back; `with_point`
/// tells reals from whole numbers where the keyword does not.
template <class T>
void put_run(Lines& lines, std::size_t count, const Element<T>& element, bool with_point) {
    if constexpr (std::is_floating_point_v<T>) {
        if (count == 1 && element.given && !with_point && std::isfinite(element.value) && lines.put_number(element.value)) return;
    }
    std::string& text = lines.scratch();
    if (count > 1 || !element.given) {
        append_number(text, std::uint64_t{count});
        text += '*';
    }
    if constexpr (std::is_same_v<T, std::string_view>) {
        const char quote = element.value.find('\'') == std::string_view::npos ? '\'' : '"';
        if (element.given) text.append(1, quote).append(element.value).append(1, quote);
    } else if constexpr (std::is_unsigned_v<T>) {
        if (element.given) append_number(text, std::uint64_t{element.value});
    } else {
        if (element.given) append_number(text, element.value);
        if (with_point && element.given && text.find_first_of(".e", text.find('*') + 1) == std::string::npos) text += ".0";
    }
    lines.put(text);
}

/// A name as it can stand between quotes: line ends become blanks, and where it has quotes of both kinds, double ones single.
inline std::string quotable(std::string_view name) {
    std::string text(name);
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    if (text.find('\'') != std::string::npos) std::ranges::replace(text, '"', '\'');
    return text;
}

/// A name in quotes, as quotable() has it.
inline std::string in_quotes(std::string_view name) {
    const char quote = name.find('\'') == std::string_view::npos ? '\'' : '"';
    return quote + quotable(name) + quote;
}

/// Writes a keyword and its array: element(i) for i < count. Several parts are made at the same time; the text does
/// not depend on how many.
template <class ElementAt>
void write_array(OutputFile& out, std::string_view keyword, std::size_t count, const ElementAt& element, bool with_point = false) {
    constexpr std::size_t grain = std::size_t{1} << 16, at_once = 16;
    out << keyword << '\n';
    std::vector<Lines> parts(std::min(at_once, count / grain + 1));
    for (std::size_t base = 0; base < count && out.good(); base += at_once * grain) {
        const std::size_t n = std::min(at_once, (count - base + grain - 1) / grain);
        parallel_for_each_index(n, [&](std::size_t part) {
            const std::size_t first = base + part * grain, last = std::min(count, first + grain);
            Lines& lines = parts[part];
            lines.clear();
            for (std::size_t i = first; i < last;) {
                const auto value = element(i);
                std::size_t next = i + 1;
                while (next < last && value.same(element(next))) ++next;
                put_run(lines, next - i, value, with_point);
                i = next;
            }
            lines.end();
        });
        for (std::size_t part = 0; part < n; ++part) out.write(parts[part].view());
    }
    out << "/\n\n";
}

}  // namespace geomend::grdecl
