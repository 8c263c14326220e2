// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/utf8.h"

#include <cstddef>
#include <cstdint>

namespace geomend {

namespace {

// Length of the well-formed sequence at the front, or 0.
std::size_t sequence_length(std::string_view s) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(s[i]); };
    const auto follows = [&](std::size_t i) { return i < s.size() && (byte(i) & 0xc0u) == 0x80u; };
    const std::uint8_t first = byte(0);
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first <= 0xdf) return follows(1) ? 2 : 0;
    if (first >= 0xe0 && first <= 0xef) {
        if (!follows(1) || !follows(2)) return 0;
        if (first == 0xe0 && byte(1) < 0xa0) return 0;
        if (first == 0xed && byte(1) > 0x9f) return 0;
        return 3;
    }
    if (first >= 0xf0 && first <= 0xf4) {
        if (!follows(1) || !follows(2) || !follows(3)) return 0;
        if (first == 0xf0 && byte(1) < 0x90) return 0;
        if (first == 0xf4 && byte(1) > 0x8f) return 0;
        return 4;
    }
    return 0;
}

}  // namespace

bool is_utf8(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::size_t n = sequence_length(bytes);
        if (n == 0) return false;
        bytes.remove_prefix(n);
    }
    return true;
}

std::string valid_utf8(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size());
    while (!bytes.empty()) {
        const std::size_t n = sequence_length(bytes);
        if (n == 0) text += "\xef\xbf\xbd";
        else text.append(bytes.substr(0, n));
        bytes.remove_prefix(n == 0 ? 1 : n);
    }
    return text;
}

std::string latin1_to_utf8(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size());
    for (const char c : bytes) {
        const auto b = static_cast<std::uint8_t>(c);
        if (b < 0x80) {
            text.push_back(c);
        } else {
            text.push_back(static_cast<char>(0xc0 | (b >> 6)));
            text.push_back(static_cast<char>(0x80 | (b & 0x3f)));
        }
    }
    return text;
}

std::string utf8_to_latin1(std::string_view text) {
    std::string bytes;
    while (!text.empty()) {
        const std::size_t n = sequence_length(text);
        if (n <= 1) {
            bytes.push_back(text[0]);
        } else {
            const auto first = static_cast<std::uint8_t>(text[0]);
            const auto second = static_cast<std::uint8_t>(text[1]);
            const bool fits = n == 2 && first <= 0xc3;
            bytes.push_back(fits ? static_cast<char>(((first & 0x03) << 6) | (second & 0x3f)) : '?');
        }
        text.remove_prefix(n == 0 ? 1 : n);
    }
    return bytes;
}

}  // namespace geomend
