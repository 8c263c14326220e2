// SPDX-License-Identifier: AGPL-3.0-or-later
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "formats/eclipse/array_writer.h"

namespace geomend::eclipse {

namespace {

/// Significant digits and the exponent of ten of 0.digits; \pre value > 0
struct Decimal {
    std::string digits;
    int exponent = 0;
};

template <class T>
Decimal decimal(T value, int count) {
    char text[64];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, count - 1);
    const std::string_view all(text, static_cast<std::size_t>(end - text));
    const std::size_t e = all.find('e');
    Decimal d;
    for (const char c : all.substr(0, e)) {
        if (c != '.') d.digits += c;
    }
    const std::size_t digits = e + (all[e + 1] == '+' ? 2 : 1);
    std::from_chars(text + digits, end, d.exponent);
    ++d.exponent;
    return d;
}

template <class T>
bool reads_back(const Decimal& d, T value) {
    const std::string text = "0." + d.digits + "e" + std::to_string(d.exponent);
    T again{};
    std::from_chars(text.data(), text.data() + text.size(), again);
    return again == value;
}

std::string exponent_text(char letter, int exponent) {
    const int size = std::abs(exponent);
    std::string text{letter, exponent < 0 ? '-' : '+'};
    if (size < 10) text += '0';
    return text + std::to_string(size);
}

template <class T>
std::string in_width(T value, char letter, int usual, int most, std::size_t width) {
    const std::string sign = std::signbit(value) ? "-" : "";
    if (value == 0) return sign + "0." + std::string(static_cast<std::size_t>(usual), '0') + exponent_text(letter, 0);
    const T size = std::abs(value);
    std::string text;
    for (int count = usual; count <= most; ++count) {
        const Decimal d = decimal(size, count);
        std::string wider = sign + "0." + d.digits + exponent_text(letter, d.exponent);
        // All digits fit where they stand as a whole number.
        if (wider.size() > width) wider = sign + d.digits + exponent_text(letter, d.exponent - count);
        if (wider.size() > width) break;
        text = std::move(wider);
        if (reads_back(d, size)) break;
    }
    return text;
}

}  // namespace

// A column is one wider, for the blank before it.
std::string fortran_real(float value) { return in_width(value, 'E', 8, 9, 16); }
std::string fortran_real(double value) { return in_width(value, 'D', 14, 17, 22); }

}  // namespace geomend::eclipse
