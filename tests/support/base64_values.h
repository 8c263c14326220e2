// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstring>
#include <string>
#include <vector>

namespace geomend::test {

/// The values behind base64 (RFC 4648) in a page, in the machine's own order.
template <class Value>
std::vector<Value> base64_values(const std::string& base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : base64) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<unsigned>(digits.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xffu);
    }
    std::vector<Value> values(bytes.size() / sizeof(Value));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), sizeof(Value) * values.size());
    return values;
}

}  // namespace geomend::test
