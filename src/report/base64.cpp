// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/base64.h"

#include <string_view>

namespace geomend {

std::string base64_of_words(std::span<const std::uint32_t> words) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t bytes = 4 * words.size();
    const auto byte = [&](std::size_t i) { return i < bytes ? words[i / 4] >> (8 * (i % 4)) & 0xffu : 0u; };
    std::string text;
    text.reserve((bytes + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes; i += 3) {
        const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (unsigned d = 0; d < 4; ++d) text += i + d > bytes ? '=' : digits[three >> (18 - 6 * d) & 63u];
    }
    return text;
}

}  // namespace geomend
