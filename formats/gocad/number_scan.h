// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstdint>

// The short way for lines as programs write them: digits, blanks, line end. Whatever is unusual (signs on ids, Fortran
// exponents, flags, comments, errors) makes these give up, and the line is read again with care and good messages.

namespace geomend::gocad {

inline bool is_blank_or_tab(char c) { return c == ' ' || c == '\t'; }

/// Takes blanks and then an unsigned integer of at most 18 digits that is followed by a blank or a line end.
inline bool scan_id(const char*& p, const char* end, std::int64_t& id) {
    while (p != end && is_blank_or_tab(*p)) ++p;
    const char* begin = p;
    std::uint64_t value = 0;
    while (p != end && static_cast<unsigned char>(*p - '0') < 10) value = 10 * value + static_cast<unsigned char>(*p++ - '0');
    const auto digits = p - begin;
    id = static_cast<std::int64_t>(value);
    return digits != 0 && digits <= 18 && p != end && static_cast<unsigned char>(*p) <= ' ';
}

/// Takes blanks and then a real number that is followed by a blank or a line end.
inline bool scan_real(const char*& p, const char* end, double& value) {
    while (p != end && is_blank_or_tab(*p)) ++p;
    const auto [stop, error] = std::from_chars(p, end, value);
    p = stop;
    return error == std::errc{} && p != end && static_cast<unsigned char>(*p) <= ' ';
}

/// The start of the next line, if only blanks are left on this one; else nullptr.
inline const char* scan_line_end(const char* p, const char* end) {
    while (p != end && (is_blank_or_tab(*p) || *p == '\r')) ++p;
    return p != end && *p == '\n' ? p + 1 : nullptr;
}

}  // namespace geomend::gocad
