// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace geomend {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// A picture of pixels, from the upper left corner, smoothed: it is drawn twice as fine. Positions are in pixels.
class Canvas {
public:
    using Place = std::array<double, 2>;

    /// \pre both sides are 1 to 10000
    Canvas(std::uint32_t width, std::uint32_t height, Colour ground);

    double width() const { return width_; }
    double height() const { return height_; }
    /// Fills a polygon; where it covers itself twice it does not. What lies outside is cut off.
    void fill(std::span<const Place> polygon, Colour colour);
    /// A line with square ends.
    void line(const Place& from, const Place& to, double thickness, Colour colour);
    void path(std::span<const Place> places, double thickness, Colour colour, bool closed = false);
    /// Capital letters, digits and marks, 7 pixels high times `size`; other letters are drawn as capitals, what is unknown as a box.
    /// The place is the upper left corner. How wide it is comes back.
    double text(const Place& at, std::string_view words, double size, Colour colour);
    static double text_width(std::string_view words, double size);

    /// As a PNG file.
    std::string png() const;

private:
    static constexpr std::uint32_t finer = 2;
    std::uint32_t width_, height_;
    std::vector<std::uint8_t> pixels_;  // finer * width * finer * height * 3
};

}  // namespace geomend
