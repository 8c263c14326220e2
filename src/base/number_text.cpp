// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/number_text.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace geomend {

namespace {

bool equal_ignoring_case(std::string_view a, std::string_view lower) {
    if (a.size() != lower.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const char c = a[i] >= 'A' && a[i] <= 'Z' ? static_cast<char>(a[i] - 'A' + 'a') : a[i];
        if (c != lower[i]) return false;
    }
    return true;
}

// from_chars already takes inf, infinity and nan; these are the spellings of C runtimes on Windows.
bool parse_non_finite(std::string_view text, double& value) {
    const bool negative = !text.empty() && text.front() == '-';
    if (negative) text.remove_prefix(1);
    if (text.substr(0, 3) != "1.#") return false;
    const std::string_view kind = text.substr(3);
    if (equal_ignoring_case(kind, "inf") || equal_ignoring_case(kind, "inf00")) {
        value = negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
        return true;
    }
    if (equal_ignoring_case(kind, "ind") || equal_ignoring_case(kind, "qnan") || equal_ignoring_case(kind, "ind00") ||
        equal_ignoring_case(kind, "qnan0") || equal_ignoring_case(kind, "snan")) {
        value = std::numeric_limits<double>::quiet_NaN();
        return true;
    }
    return false;
}

// A Fortran exponent (1.0D+05) is copied with an e; numbers longer than the buffer are not numbers.
NumberStatus parse_slowly(std::string_view text, double& value) {
    if (parse_non_finite(text, value)) return NumberStatus::ok;
    char buffer[512];
    if (text.empty() || text.size() > sizeof buffer) return NumberStatus::malformed;
    bool replaced = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool d = text[i] == 'd' || text[i] == 'D';
        replaced |= d;
        buffer[i] = d ? 'e' : text[i];
    }
    if (!replaced) return NumberStatus::malformed;
    const auto [end, error] = std::from_chars(buffer, buffer + text.size(), value);
    if (end != buffer + text.size()) return NumberStatus::malformed;
    return error == std::errc{} ? NumberStatus::ok : NumberStatus::out_of_range;
}

// from_chars gives result_out_of_range for underflow as well as for overflow; a wider type tells which.
NumberStatus settle_range(std::string_view text, double& value) {
    long double wide = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), wide);
    bool tiny = std::fabs(wide) < 1;
    if (error != std::errc{}) {
        const std::size_t e = text.find_first_of("eE");
        tiny = e != std::string_view::npos && text.substr(e + 1, 1) == "-";
        wide = 0;
    }
    if (!tiny) return NumberStatus::out_of_range;
    value = std::copysign(static_cast<double>(wide), text.front() == '-' ? -1.0 : 1.0);
    return NumberStatus::ok;
}

template <class Integer>
NumberStatus parse_whole(std::string_view text, Integer& value) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) return NumberStatus::out_of_range;
    if (error != std::errc{} || end != text.data() + text.size()) return NumberStatus::malformed;
    return NumberStatus::ok;
}

template <class Number>
void append(std::string& out, Number value) {
    char buffer[40];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    out.append(buffer, end);
}

template <class Real>
void append_real(std::string& out, Real value) {
    if (std::isnan(value)) out += "nan";
    else append(out, value);
}

}  // namespace

NumberStatus parse_real(std::string_view text, double& value) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end == text.data() + text.size()) {
        if (error == std::errc{}) [[likely]]
            return NumberStatus::ok;
        if (error == std::errc::result_out_of_range) return settle_range(text, value);
    }
    return parse_slowly(text, value);
}

NumberStatus parse_integer(std::string_view text, std::int64_t& value) { return parse_whole(text, value); }
NumberStatus parse_integer(std::string_view text, std::uint64_t& value) { return parse_whole(text, value); }

void append_number(std::string& out, double value) { append_real(out, value); }
void append_number(std::string& out, float value) { append_real(out, value); }
void append_number(std::string& out, std::int64_t value) { append(out, value); }
void append_number(std::string& out, std::uint64_t value) { append(out, value); }

std::string number_text(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

}  // namespace geomend
