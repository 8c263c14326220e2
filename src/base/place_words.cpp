// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/place_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace geomend {
namespace {

/// Decimals that give a number of this size eight digits, and thousandths at least.
int decimals_for(double size) {
    constexpr int digits = 8, least = 3, most = 300;
    if (!(size > 0) || !std::isfinite(size)) return least;
    return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(size))), least, most);
}

std::string with_decimals(double value, int decimals) {
    char text[400];
    constexpr double huge = 1e15;
    if (!std::isfinite(value) || std::abs(value) >= huge) {
        std::snprintf(text, sizeof text, "%.6g", value);
        return text;
    }
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    std::string words = text;
    words.erase(words.find_last_not_of('0') + 1);
    if (words.back() == '.') words.pop_back();
    return words == "-0" ? "0" : words;
}

}  // namespace

std::string coordinate(double value) { return with_decimals(value, decimals_for(std::abs(value))); }

std::string place_words(const std::array<double, 3>& place) {
    const int decimals = decimals_for(std::max({std::abs(place[0]), std::abs(place[1]), std::abs(place[2])}));
    return '(' + with_decimals(place[0], decimals) + ", " + with_decimals(place[1], decimals) + ", " + with_decimals(place[2], decimals) +
           ')';
}

}  // namespace geomend
