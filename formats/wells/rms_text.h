// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "base/number_text.h"
#include "base/text_cursor.h"

// What the reader and the writer of RMS wells have in common.

namespace geomend::wells {

inline constexpr double missing = -999;
inline constexpr std::string_view type_key = "well.type", version_key = "well.version", depth_log_key = "well.depth_log",
                                  record_key = "well.record";
inline constexpr double highest_bushing = 1000;  // above the sea; larger numbers are coordinates

inline std::vector<std::string_view> tokens_of(std::string_view line) {
    std::vector<std::string_view> tokens;
    TextCursor cursor(line);
    cursor.next_line();
    for (std::string_view t = cursor.token(); !t.empty(); t = cursor.token()) tokens.push_back(t);
    return tokens;
}

inline bool is_number(std::string_view token) {
    double value = 0;
    return parse_real(token, value) == NumberStatus::ok && std::isfinite(value);
}

}  // namespace geomend::wells
