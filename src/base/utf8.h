// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace geomend {

/// Whether the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates).
bool is_utf8(std::string_view bytes);

/// The text with U+FFFD in place of each byte that is of no well-formed sequence.
std::string valid_utf8(std::string_view bytes);

/// Each byte as the character of that number.
std::string latin1_to_utf8(std::string_view bytes);
/// The way back; characters beyond U+00FF become '?'.
std::string utf8_to_latin1(std::string_view text);

}  // namespace geomend
