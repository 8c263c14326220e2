// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace geomend {

enum class NumberStatus : std::uint8_t { ok, malformed, out_of_range };

/// Reads a real number that takes up the whole text: decimal point, optional sign (also '+'), exponent
/// with e, E, d or D. Non-finite spellings (inf, -inf, nan, 1.#INF, -1.#IND, ...) give ok and a non-finite
/// value; whether that is allowed is the caller's matter. A value too small for a double reads as zero or
/// the nearest subnormal; one too large is out_of_range. Locale-free.
NumberStatus parse_real(std::string_view text, double& value);

/// Reads an integer that takes up the whole text; a sign is allowed. "3.0" is malformed.
NumberStatus parse_integer(std::string_view text, std::int64_t& value);
NumberStatus parse_integer(std::string_view text, std::uint64_t& value);

/// Appends the shortest digits that read back to the same double (or float). Non-finite values are
/// written as nan, inf, -inf.
void append_number(std::string& out, double value);
void append_number(std::string& out, float value);
void append_number(std::string& out, std::int64_t value);
void append_number(std::string& out, std::uint64_t value);
inline void append_number(std::string& out, std::int32_t value) { append_number(out, std::int64_t{value}); }
inline void append_number(std::string& out, std::uint32_t value) { append_number(out, std::uint64_t{value}); }

/// Same as append_number, as a new string.
std::string number_text(double value);

}  // namespace geomend
