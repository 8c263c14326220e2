// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace geomend::gmsh {

// Number taking for regular text sections. A section's text is always followed by the '$' of its $End, which is
// neither a digit nor a blank: that is why the loops below need no test for the end.

inline const char* skip_blanks(const char* p) {
    while (*p == ' ' || *p == '\t') ++p;
    return p;
}

/// An unsigned number of at most 18 digits after blanks; nullptr where there is none.
inline const char* take_unsigned(const char* p, std::uint64_t& value) {
    p = skip_blanks(p);
    const char* digits = p;
    std::uint64_t v = 0;
    unsigned digit = 0;
    while ((digit = static_cast<unsigned char>(*p) - unsigned{'0'}) < 10) {
        v = v * 10 + digit;
        ++p;
    }
    value = v;
    return p == digits || p - digits > 18 ? nullptr : p;
}

/// A finite real number after blanks; nullptr where there is none.
inline const char* take_finite(const char* p, const char* end, double& value) {
    p = skip_blanks(p);
    const auto [stop, error] = std::from_chars(p, end, value);
    return error == std::errc{} && std::isfinite(value) ? stop : nullptr;
}

/// The start of the next line when nothing but blanks is left of this one; else nullptr.
inline const char* take_line_end(const char* p, const char* end) {
    p = skip_blanks(p);
    if (*p == '\r') ++p;
    if (*p == '\n') return p + 1;
    return p == end ? p : nullptr;
}

inline const char* next_line(const char* p, const char* end) {
    const void* newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
    return newline == nullptr ? end : static_cast<const char*>(newline) + 1;
}

/// Some lines of a text.
struct LinePiece {
    const char* begin = nullptr;
    const char* end = nullptr;
};

/// Cuts a text at line starts into pieces of about `bytes` bytes.
inline std::vector<LinePiece> cut_at_lines(const char* begin, const char* end, std::size_t bytes) {
    std::vector<LinePiece> pieces;
    while (begin != end) {
        const std::size_t left = static_cast<std::size_t>(end - begin);
        const char* stop = left <= bytes ? end : next_line(begin + bytes - 1, end);
        pieces.push_back({begin, stop});
        begin = stop;
    }
    return pieces;
}

/// Number of lines; a last line without its end counts.
inline std::size_t line_count(LinePiece piece) {
    const auto ends = static_cast<std::size_t>(std::count(piece.begin, piece.end, '\n'));
    return piece.begin != piece.end && piece.end[-1] != '\n' ? ends + 1 : ends;
}

inline constexpr std::size_t piece_bytes = std::size_t{1} << 18;
inline constexpr std::size_t piece_lines = std::size_t{1} << 13;

}  // namespace geomend::gmsh
