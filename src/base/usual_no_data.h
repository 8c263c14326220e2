// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace geomend {

/// Whether a height or depth, of either sign, is 999 or 9999, which programs write for "no value", but at which some models end.
inline bool is_round_no_data(double height) {
    const auto z = static_cast<float>(std::abs(height));
    return z == 999.0F || z == 9999.0F;
}

/// Whether it is a number that programs write for "no value" and that is no height of anything, such as -999.25, -99999 or 1e10.
/// Compared in single precision, in which many files hold them.
inline bool is_odd_no_data(double height) {
    constexpr std::array numbers = {999.25,   999.99,    9999.25,   9999.99, 32767.0, 32768.0,      99999.0,      99999.99, 999999.0,
                                    999999.9, 9999900.0, 9999999.0, 1e9,     1e10,    2147483647.0, 2147483648.0, 1e15};
    const auto z = static_cast<float>(std::abs(height));
    return z >= 999 && std::ranges::any_of(numbers, [&](double usual) { return static_cast<float>(usual) == z; });
}

}  // namespace geomend
