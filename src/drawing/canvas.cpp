// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/canvas.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace geomend {

namespace {

/// A character as seven rows of five dots, the leftmost dot in the highest bit.
struct Glyph {
    char letter;
    std::array<std::uint8_t, 7> rows;
};
constexpr std::array glyphs{
    Glyph{'0', {14, 17, 19, 21, 25, 17, 14}}, Glyph{'1', {4, 12, 4, 4, 4, 4, 14}},      Glyph{'2', {14, 17, 1, 6, 8, 16, 31}},
    Glyph{'3', {30, 1, 1, 14, 1, 1, 30}},     Glyph{'4', {2, 6, 10, 18, 31, 2, 2}},     Glyph{'5', {31, 16, 30, 1, 1, 17, 14}},
    Glyph{'6', {6, 8, 16, 30, 17, 17, 14}},   Glyph{'7', {31, 1, 2, 4, 8, 8, 8}},       Glyph{'8', {14, 17, 17, 14, 17, 17, 14}},
    Glyph{'9', {14, 17, 17, 15, 1, 2, 12}},   Glyph{'A', {14, 17, 17, 31, 17, 17, 17}}, Glyph{'B', {30, 17, 17, 30, 17, 17, 30}},
    Glyph{'C', {14, 17, 16, 16, 16, 17, 14}}, Glyph{'D', {30, 17, 17, 17, 17, 17, 30}}, Glyph{'E', {31, 16, 16, 30, 16, 16, 31}},
    Glyph{'F', {31, 16, 16, 30, 16, 16, 16}}, Glyph{'G', {14, 17, 16, 23, 17, 17, 14}}, Glyph{'H', {17, 17, 17, 31, 17, 17, 17}},
    Glyph{'I', {14, 4, 4, 4, 4, 4, 14}},      Glyph{'J', {7, 2, 2, 2, 2, 18, 12}},      Glyph{'K', {17, 18, 20, 24, 20, 18, 17}},
    Glyph{'L', {16, 16, 16, 16, 16, 16, 31}}, Glyph{'M', {17, 27, 21, 21, 17, 17, 17}}, Glyph{'N', {17, 25, 21, 19, 17, 17, 17}},
    Glyph{'O', {14, 17, 17, 17, 17, 17, 14}}, Glyph{'P', {30, 17, 17, 30, 16, 16, 16}}, Glyph{'Q', {14, 17, 17, 17, 21, 18, 13}},
    Glyph{'R', {30, 17, 17, 30, 20, 18, 17}}, Glyph{'S', {15, 16, 16, 14, 1, 1, 30}},   Glyph{'T', {31, 4, 4, 4, 4, 4, 4}},
    Glyph{'U', {17, 17, 17, 17, 17, 17, 14}}, Glyph{'V', {17, 17, 17, 17, 17, 10, 4}},  Glyph{'W', {17, 17, 17, 21, 21, 27, 17}},
    Glyph{'X', {17, 17, 10, 4, 10, 17, 17}},  Glyph{'Y', {17, 17, 10, 4, 4, 4, 4}},     Glyph{'Z', {31, 1, 2, 4, 8, 16, 31}},
    Glyph{' ', {0, 0, 0, 0, 0, 0, 0}},        Glyph{'.', {0, 0, 0, 0, 0, 12, 12}},      Glyph{',', {0, 0, 0, 0, 12, 4, 8}},
    Glyph{'-', {0, 0, 0, 31, 0, 0, 0}},       Glyph{'_', {0, 0, 0, 0, 0, 0, 31}},       Glyph{';', {0, 12, 12, 0, 12, 4, 8}},
    Glyph{':', {0, 12, 12, 0, 12, 12, 0}},    Glyph{'/', {1, 1, 2, 4, 8, 16, 16}},      Glyph{'(', {2, 4, 8, 8, 8, 4, 2}},
    Glyph{')', {8, 4, 2, 2, 2, 4, 8}},        Glyph{'+', {0, 4, 4, 31, 4, 4, 0}},       Glyph{'=', {0, 0, 31, 0, 31, 0, 0}},
    Glyph{'%', {25, 25, 2, 4, 8, 19, 19}}};
constexpr Glyph unknown{'?', {31, 17, 17, 17, 17, 17, 31}};
constexpr double advance = 6;

const Glyph& glyph_of(char letter) {
    const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    const auto found = std::ranges::find(glyphs, capital, &Glyph::letter);
    return found == glyphs.end() ? unknown : *found;
}

void put_number(std::string& out, std::uint32_t n) {
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(n >> shift & 0xff);
}

/// A chunk of a PNG file: length, name, data, checksum.
void put_chunk(std::string& out, const std::string& name, const std::string& data) {
    put_number(out, static_cast<std::uint32_t>(data.size()));
    const std::string summed = name + data;
    out += summed;
    put_number(out, static_cast<std::uint32_t>(
                        crc32(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()))));
}

std::string deflated(const std::string& data) {
    uLongf size = compressBound(static_cast<uLong>(data.size()));
    std::string out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size()),
                  9) != Z_OK)
        throw std::bad_alloc();  // the only way to fail with room enough
    out.resize(size);
    return out;
}

}  // namespace

Canvas::Canvas(std::uint32_t width, std::uint32_t height, Colour ground)
    : width_(width), height_(height), pixels_(std::size_t{finer} * width * finer * height * 3) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) pixels_[i] = ground[i % 3];
}

void Canvas::fill(std::span<const Place> polygon, Colour colour) {
    if (polygon.size() < 3) return;
    double low = 1e300, high = -1e300;
    for (const Place& p : polygon) {
        if (!std::isfinite(p[0]) || !std::isfinite(p[1])) return;
        low = std::min(low, p[1] * finer);
        high = std::max(high, p[1] * finer);
    }
    const double columns = finer * width_, rows = finer * height_;
    const auto first = static_cast<std::uint32_t>(std::clamp(std::floor(low), 0.0, rows));
    const auto last = static_cast<std::uint32_t>(std::clamp(std::ceil(high) + 1, 0.0, rows));
    std::vector<double> crossings;
    for (std::uint32_t y = first; y < last; ++y) {
        const double at = y + 0.5;
        crossings.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Place &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            const double a = p[1] * finer, b = q[1] * finer;
            if ((a <= at) == (b <= at)) continue;
            crossings.push_back(finer * (p[0] + (q[0] - p[0]) * (at - a) / (b - a)));
        }
        std::ranges::sort(crossings);
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
            // Pixels whose middles lie between the two.
            const auto from = static_cast<std::size_t>(std::clamp(std::ceil(crossings[i] - 0.5), 0.0, columns));
            const auto to = static_cast<std::size_t>(std::clamp(std::ceil(crossings[i + 1] - 0.5), 0.0, columns));
            std::uint8_t* row = pixels_.data() + 3 * static_cast<std::size_t>(columns) * y;
            for (std::size_t x = from; x < to; ++x) std::ranges::copy(colour, row + 3 * x);
        }
    }
}

void Canvas::line(const Place& from, const Place& to, double thickness, Colour colour) {
    const double dx = to[0] - from[0], dy = to[1] - from[1], length = std::hypot(dx, dy);
    const double half = thickness / 2, u = length > 0 ? half * dx / length : half, v = length > 0 ? half * dy / length : 0;
    const std::array<Place, 4> corners{Place{from[0] - u - v, from[1] - v + u}, Place{to[0] + u - v, to[1] + v + u},
                                       Place{to[0] + u + v, to[1] + v - u}, Place{from[0] - u + v, from[1] - v - u}};
    fill(corners, colour);
}

void Canvas::path(std::span<const Place> places, double thickness, Colour colour, bool closed) {
    for (std::size_t i = 1; i < places.size(); ++i) line(places[i - 1], places[i], thickness, colour);
    if (closed && places.size() > 2) line(places.back(), places.front(), thickness, colour);
}

double Canvas::text(const Place& at, std::string_view words, double size, Colour colour) {
    double x = at[0];
    for (const char letter : words) {
        const Glyph& glyph = glyph_of(letter);
        for (std::size_t row = 0; row < glyph.rows.size(); ++row) {
            for (std::size_t dot = 0; dot < 5; ++dot) {
                if ((glyph.rows[row] >> (4 - dot) & 1) == 0) continue;
                const double left = x + size * static_cast<double>(dot), top = at[1] + size * static_cast<double>(row);
                const std::array<Place, 4> box{Place{left, top}, Place{left + size, top}, Place{left + size, top + size},
                                               Place{left, top + size}};
                fill(box, colour);
            }
        }
        x += advance * size;
    }
    return x - at[0];
}

double Canvas::text_width(std::string_view words, double size) { return advance * size * static_cast<double>(words.size()); }

std::string Canvas::png() const {
    std::string rows;
    rows.reserve((std::size_t{width_} * 3 + 1) * height_);
    const std::size_t step = std::size_t{finer} * width_ * 3;
    for (std::size_t y = 0; y < height_; ++y) {
        rows += '\0';  // no filter
        for (std::size_t x = 0; x < width_; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                unsigned sum = 0;
                for (std::size_t i = 0; i < finer * finer; ++i)
                    sum += pixels_[step * (finer * y + i / finer) + 3 * (finer * x + i % finer) + c];
                rows += static_cast<char>(sum / (finer * finer));
            }
        }
    }
    std::string head;
    put_number(head, width_);
    put_number(head, height_);
    head += std::string("\x08\x02\0\0\0", 5);  // eight bits, red green blue, no interlacing
    std::string out = "\x89PNG\r\n\x1a\n";
    put_chunk(out, "IHDR", head);
    put_chunk(out, "IDAT", deflated(rows));
    put_chunk(out, "IEND", "");
    return out;
}

}  // namespace geomend
