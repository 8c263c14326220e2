// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

namespace geomend {

/// What editors on Windows put before text in UTF-8; no part of it.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// A text from behind its byte order mark on.
inline std::string_view without_byte_order_mark(std::string_view text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return text;
}

}  // namespace geomend
