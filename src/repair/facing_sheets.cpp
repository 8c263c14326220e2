// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/facing_sheets.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <system_error>
#include <tuple>

#include "base/length.h"
#include "base/vectors.h"
#include "geometry/box_tree.h"
#include "geometry/closest_points.h"
#include "model/objects.h"
#include "repair/soup_edges.h"
#include "repair/soup_measures.h"
#include "validators/closing_tolerance.h"

namespace geomend::repair {

namespace {

/// How far a corner of one of two pieces is from the other piece.
struct SheetDistance {
    std::uint32_t low, high;  ///< the pieces
    double distance;
    double height;  ///< of the lower piece above the other one, along the normal of the other
};

/// A corner of a triangle of a piece.
struct PieceCorner {
    std::uint32_t piece, vertex, triangle;
};

std::vector<PieceCorner> corners_by_vertex(const TriangleSoup& soup, const PatchPieces& pieces) {
    std::vector<PieceCorner> corners;
    corners.reserve(3 * soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (pieces.of[t] == no_index) continue;
        for (const std::uint32_t v : soup.triangles[t]) corners.push_back({pieces.of[t], v, t});
    }
    std::ranges::sort(corners, [](const PieceCorner& a, const PieceCorner& b) {
        return std::tie(a.vertex, a.piece, a.triangle) < std::tie(b.vertex, b.piece, b.triangle);
    });
    return corners;
}

/// Measures from corners to other pieces.
class SheetSearch {
public:
    SheetSearch(const TriangleSoup& soup, double near)
        : soup_(soup), near_(near), pieces_(pieces_between_lines(soup, edges_of(soup))), tree_(triangle_boxes(soup)) {}

    std::vector<SheetDistance> distances() {
        const auto corners = corners_by_vertex(soup_, pieces_);
        for (std::size_t first = 0, end = 0; first < corners.size(); first = end) {
            while (end < corners.size() && corners[end].vertex == corners[first].vertex) ++end;
            from_vertex(std::span(corners).subspan(first, end - first));
        }
        return std::move(found_);
    }

private:
    const TriangleSoup& soup_;
    double near_;
    PatchPieces pieces_;
    BoxTree tree_;
    std::vector<SheetDistance> found_;

    struct Nearest {
        std::uint32_t piece, triangle;
        double distance;
        Vec3 apart;
    };
    std::vector<Nearest> nearest_;  ///< per piece near one vertex

    /// \param corners all of one vertex, by piece
    void from_vertex(std::span<const PieceCorner> corners) {
        const Vec3& p = soup_.vertices[corners.front().vertex];
        BoxTree::Corners box{p, p};
        for (std::size_t k = 0; k < 3; ++k) {
            box[0][k] -= near_;
            box[1][k] += near_;
        }
        nearest_.clear();
        tree_.visit(box, -1e-9 * near_, [&](std::uint32_t t) { look_at(p, t, corners); });
        for (std::size_t first = 0, end = 0; first < corners.size(); first = end) {
            while (end < corners.size() && corners[end].piece == corners[first].piece) ++end;
            for (const Nearest& there : nearest_) add(corners.subspan(first, end - first), there);
        }
    }

    void look_at(const Vec3& p, std::uint32_t t, std::span<const PieceCorner> corners) {
        const std::uint32_t piece = pieces_.of[t];
        if (piece == no_index || std::ranges::find(corners, piece, &PieceCorner::piece) != corners.end()) return;
        const Triangle& tri = soup_.triangles[t];
        const Closest there = closest_points(p, {soup_.vertices[tri[0]], soup_.vertices[tri[1]], soup_.vertices[tri[2]]});
        if (there.distance > near_) return;
        const auto known = std::ranges::find(nearest_, piece, &Nearest::piece);
        if (known == nearest_.end()) nearest_.push_back({piece, t, there.distance, there.apart});
        else if (there.distance < known->distance) *known = {piece, t, there.distance, there.apart};
    }

    /// \param corners of one vertex in one piece
    void add(std::span<const PieceCorner> corners, const Nearest& there) {
        constexpr double facing = 0.7;  // cosine: what meets more steeply is no sheet along the other
        const Vec3 normal = triangle_normal(soup_, there.triangle);
        const double size = length(normal);
        double most_alike = 0;
        for (const PieceCorner& corner : corners) {
            const Vec3 own = triangle_normal(soup_, corner.triangle);
            const double alike = dot(own, normal) / (length(own) * size);
            if (std::abs(alike) > std::abs(most_alike)) most_alike = alike;
        }
        if (!(std::abs(most_alike) > facing)) return;
        const double above = -dot(there.apart, normal) / size;  // of the vertex, along the normal of what is near it
        const std::uint32_t own = corners.front().piece;
        if (own < there.piece) found_.push_back({own, there.piece, there.distance, above});
        else found_.push_back({there.piece, own, there.distance, most_alike > 0 ? -above : above});
    }
};

bool is_written_with(double value, int digits, std::chars_format format) {
    if (format == std::chars_format::fixed && digits < 0) return std::fmod(value, std::pow(10.0, -digits)) == 0;
    std::array<char, 64> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value, format, digits);
    double read = 0;
    return written.ec == std::errc() && std::from_chars(text.data(), written.ptr, read).ec == std::errc() && read == value;
}

/// The step of numbers in text: so many decimals, or none, or so many digits of the largest, where most have as many. Round numbers that
/// somebody chose have fewer. 0: they are not rounded.
double text_step(const TriangleSoup& soup) {
    constexpr int most_decimals = 6, most_digits = 8;
    double largest = 0;
    int decimals = 0, digits = 1;
    for (const Vec3& p : soup.vertices) {
        for (const double x : p) {
            largest = std::max(largest, std::abs(x));
            while (decimals <= most_decimals && !is_written_with(x, decimals, std::chars_format::fixed)) ++decimals;
            while (digits <= most_digits && !is_written_with(x, digits - 1, std::chars_format::scientific)) ++digits;
            if (decimals > most_decimals && digits > most_digits) return 0;
        }
    }
    const auto most_need = [&](int count, std::chars_format format) {
        std::size_t need = 0;
        for (const Vec3& p : soup.vertices) {
            need += static_cast<std::size_t>(std::ranges::count_if(p, [&](double x) { return !is_written_with(x, count - 1, format); }));
        }
        return 2 * need > 3 * soup.vertices.size();
    };
    double step = 0;
    if (decimals <= most_decimals && most_need(decimals, std::chars_format::fixed)) step = std::pow(10.0, -decimals);
    if (digits >= 2 && digits <= most_digits && largest > 0 && most_need(digits - 1, std::chars_format::scientific))
        step = std::max(step, std::pow(10.0, std::floor(std::log10(largest)) + 1 - digits));
    return step;
}

/// Whether a number has so many bits at most.
bool has_bits(double value, int bits) {
    int exponent = 0;
    const double scaled = std::ldexp(std::frexp(value, &exponent), bits);
    return scaled == std::floor(scaled);
}

/// A number of single precision in full, or in the nine digits that tell it from others.
bool is_single(double value) {
    const double nearest = static_cast<float>(value);
    std::array<char, 64> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), nearest, std::chars_format::general, 9);
    double read = 0;
    return value == nearest ||
           (written.ec == std::errc() && std::from_chars(text.data(), written.ptr, read).ec == std::errc() && read == value);
}

/// The step of single precision at the largest coordinate, where all are of it, and most have more bits than round numbers. 0: they are
/// not.
double single_step(const TriangleSoup& soup) {
    constexpr int own_bits = 24, few_bits = 18;
    double largest = 0;
    std::size_t need = 0;
    for (const Vec3& p : soup.vertices) {
        for (const double x : p) {
            if (!is_single(x)) return 0;
            largest = std::max(largest, std::abs(x));
            need += has_bits(x, few_bits) ? 0 : 1;
        }
    }
    if (2 * need <= 3 * soup.vertices.size()) return 0;
    return std::ldexp(1.0, std::ilogb(largest) + 1 - own_bits);
}

/// The step to which all coordinates are rounded. 0: they are not.
double rounding_of(const TriangleSoup& soup) { return std::max(text_step(soup), single_step(soup)); }

/// Whether two pieces lie now on one side of each other and now on the other, as far as they are no farther apart than some length.
/// Those that lie on one side by no more than coordinates tell apart, on average, do so, too.
bool runs_through(std::span<const SheetDistance> of_pair, double length, double rounding) {
    constexpr double one_sided = 0.6;
    std::size_t count = 0;
    double sum = 0, size = 0;
    bool above = false, below = false;
    for (const SheetDistance& d : of_pair) {
        if (d.distance > length) continue;
        ++count;
        sum += d.height;
        size += std::abs(d.height);
        above |= d.height > 0;
        below |= d.height < 0;
    }
    return (above && below && std::abs(sum) <= one_sided * size) || (count > 0 && size <= 0.5 * rounding * static_cast<double>(count));
}

}  // namespace

std::vector<SheetTolerance> sheet_tolerances(const TriangleSoup& soup, double tolerance, double near) {
    auto distances = SheetSearch(soup, near).distances();
    std::erase_if(distances, [&](const SheetDistance& d) { return d.distance <= tolerance; });
    std::ranges::stable_sort(
        distances, [](const SheetDistance& a, const SheetDistance& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
    std::vector<std::span<const SheetDistance>> pairs;
    for (std::size_t first = 0, end = 0; first < distances.size(); first = end) {
        while (end < distances.size() && distances[end].low == distances[first].low && distances[end].high == distances[first].high) ++end;
        pairs.push_back(std::span(distances).subspan(first, end - first));
    }
    std::vector<double> lengths;
    lengths.reserve(distances.size());
    for (const SheetDistance& d : distances) lengths.push_back(d.distance);
    constexpr double few_steps = 4;
    const double rounding = distances.empty() ? 0 : rounding_of(soup);
    std::vector<SheetTolerance> sheets;
    for (const double length : validators::tolerances_to_try(lengths, tolerance, near)) {
        const auto within = [&](const auto& pair) {
            return std::ranges::any_of(pair, [&](const auto& d) { return d.distance <= length; });
        };
        const auto weaves = [&](const auto& pair) { return runs_through(pair, length, rounding); };
        if (std::ranges::none_of(pairs, weaves)) continue;
        const bool flattens = std::ranges::any_of(pairs, [&](const auto& pair) { return within(pair) && !weaves(pair); });
        sheets.push_back({length, flattens, length <= few_steps * rounding});
    }
    return sheets;
}

}  // namespace geomend::repair
