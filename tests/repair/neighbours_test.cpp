// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "base/vec3.h"
#include "region_volumes.h"
#include "support/program.h"

// Closed bodies beside each other, in single precision or rounded in text: their common side is not the same in both.

namespace geomend {
namespace {

using test::info;
using test::region_volumes;
using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

constexpr double side = 100;

/// A place of two cubes in a row, turned about two axes, in single precision or to whole metres.
Vec3 placed(const Vec3& p, double turn, bool whole) {
    const double c = std::cos(turn), s = std::sin(turn), d = std::cos(0.3 * turn), e = std::sin(0.3 * turn);
    const Vec3 q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
    const Vec3 r{4000 + q[0], 6000 + d * q[1] - e * q[2], -900 + e * q[1] + d * q[2]};
    if (whole) return {std::round(r[0]), std::round(r[1]), std::round(r[2])};
    return {static_cast<float>(r[0]), static_cast<float>(r[1]), static_cast<float>(r[2])};
}

/// A cube as a legacy VTK file; the sides of the second one are split along other diagonals, and it is a quarter longer across.
std::string cube_text(bool second, double turn, bool whole = false) {
    const double low = second ? side : 0, wide = second ? 1.25 * side : side;
    std::string text =
        "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET POLYDATA\nPOINTS 8 " + std::string(whole ? "double" : "float") + '\n';
    for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 p = placed({low + ((i & 1U) != 0 ? side : 0), (i & 2U) != 0 ? wide : 0, (i & 4U) != 0 ? side : 0}, turn, whole);
        for (const double x : p) text += number_text(x) + ' ';
        text += '\n';
    }
    constexpr std::array<std::array<std::size_t, 4>, 6> sides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    text += "POLYGONS 12 48\n";
    const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
    };
    for (const auto& [a, b, c, d] : sides) {
        triangle(a, b, second ? d : c);
        second ? triangle(b, c, d) : triangle(a, c, d);
    }
    return text;
}

TEST(Neighbours, WithACommonSideBecomeTwoRegionsInWhateverOrder) {
    const TemporaryFolder folder;
    for (int i = 1; i <= 12; ++i) {
        const double turn = 0.37 * i;
        write_file(folder / "a.vtk", cube_text(false, turn));
        write_file(folder / "b.vtk", cube_text(true, turn));
        for (const auto& [first, last] : {std::array{"a.vtk", "b.vtk"}, std::array{"b.vtk", "a.vtk"}}) {
            const auto run = run_geomend({"repair", folder / first, folder / last, "-o", folder / "out.ml"});
            ASSERT_EQ(run.status, 0) << turn << '\n' << run.out << run.err;
            double sum = 0, least = 1e300;
            const auto volumes = info(folder / "out.ml")["brep"]["region_volumes"];
            ASSERT_EQ(volumes.size(), 2u) << turn << ' ' << first << '\n' << run.out;
            for (const auto& region : volumes) {
                sum += region["volume"].get<double>();
                least = std::min(least, region["volume"].get<double>());
            }
            EXPECT_NEAR(sum, 2.25e6, 100) << turn;  // a step of the coordinates is 0.5 mm
            EXPECT_NEAR(least, 1e6, 100) << turn;
        }
    }
}

// The steps are too large for cubes of that size to be taken as one unasked; what is written says how far it takes, and that does it.
TEST(Neighbours, RoundedTooCoarselyAreNamedWithTheLengthThatJoinsThem) {
    const TemporaryFolder folder;
    const std::string words = ": with --tolerance ";
    for (int i = 1; i <= 6; ++i) {
        const double turn = 0.37 * i;
        write_file(folder / "a.vtk", cube_text(false, turn, true));
        write_file(folder / "b.vtk", cube_text(true, turn, true));
        const auto run = run_geomend({"repair", folder / "a.vtk", folder / "b.vtk", "-o", folder / "out.ml"});
        const auto at = run.out.find(words);
        if (run.status == 0 && region_volumes(folder / "out.ml").size() == 2) continue;
        ASSERT_NE(at, std::string::npos) << turn << '\n' << run.out;
        const std::string length = run.out.substr(at + words.size(), run.out.find(' ', at + words.size()) - at - words.size());
        const auto again = run_geomend({"repair", folder / "a.vtk", folder / "b.vtk", "-o", folder / "out.ml", "--tolerance", length});
        ASSERT_EQ(again.status, 0) << turn << ' ' << length << '\n' << again.out << again.err;
        EXPECT_EQ(region_volumes(folder / "out.ml").size(), 2u) << turn << '\n' << again.out;
    }
}

/// How a text rounds: to decimals, to digits, or, with so many digits, to single precision.
struct Rounding {
    char format;  ///< of printf: f or g; s for single precision
    int digits;

    std::string text(double x) const {
        std::array<char, 64> number{};
        if (format == 's') x = static_cast<float>(x);
        std::snprintf(number.data(), number.size(), format == 'f' ? "%.*f" : "%.*g", digits, x);
        return number.data();
    }
};

/// The body between two tilted planes over a rectangle, each side with a grid of its own.
struct Slab {
    double low = 0, high = 0;  ///< where the planes pass the origin
    bool tilted_low = false, tilted_high = false;
    unsigned columns = 1, rows = 1;
};

constexpr double slab_x = 1000, slab_y = 800;

double height(double at_origin, bool tilted, double x, double y) { return at_origin + (tilted ? 0.1 * x - 0.05 * y : 0); }

/// A TSurf of the sides of a slab, turned, far from the origin unless it is rounded to digits.
std::string slab_text(const std::string& name, const Slab& slab, const Rounding& rounding, double turn) {
    std::string text = "GOCAD TSurf 1\nHEADER {\nname:" + name + "\n}\nTFACE\n", triangles;
    unsigned count = 0;
    const double c = std::cos(turn), s = std::sin(turn), d = std::cos(0.6 * turn), e = std::sin(0.6 * turn);
    const Vec3 shift = rounding.format == 'g' ? Vec3{} : Vec3{4e5, 6e6, -1000};
    const auto vertex = [&](double x, double y, double t) {
        const double low = height(slab.low, slab.tilted_low, x, y), high = height(slab.high, slab.tilted_high, x, y);
        const double z = low + t * (high - low), p = c * x - s * y, q = s * x + c * y;
        text += "VRTX " + std::to_string(++count);
        for (const double w : {shift[0] + p, shift[1] + d * q - e * z, shift[2] + e * q + d * z}) text += ' ' + rounding.text(w);
        text += '\n';
    };
    const auto grid = [&](unsigned columns, unsigned rows, const auto& place) {
        const unsigned first = count + 1;
        for (unsigned j = 0; j <= rows; ++j) {
            for (unsigned i = 0; i <= columns; ++i) place(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
        }
        for (unsigned j = 0; j < rows; ++j) {
            for (unsigned i = 0; i < columns; ++i) {
                const unsigned a = first + j * (columns + 1) + i, b = a + columns + 1;
                triangles += "TRGL " + std::to_string(a) + ' ' + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + '\n';
                triangles += "TRGL " + std::to_string(a) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(b) + '\n';
            }
        }
    };
    grid(slab.columns, slab.rows, [&](double u, double v) { vertex(slab_x * (1 - u), slab_y * v, 0); });
    grid(slab.columns, slab.rows, [&](double u, double v) { vertex(slab_x * u, slab_y * v, 1); });
    grid(slab.columns, 1, [&](double u, double t) { vertex(slab_x * u, 0, t); });
    grid(slab.rows, 1, [&](double u, double t) { vertex(slab_x, slab_y * u, t); });
    grid(slab.columns, 1, [&](double u, double t) { vertex(slab_x * (1 - u), slab_y, t); });
    grid(slab.rows, 1, [&](double u, double t) { vertex(0, slab_y * (1 - u), t); });
    return text + triangles + "END\n";
}

double volume(const Slab& slab) {
    const double middle =
        height(slab.high, slab.tilted_high, slab_x / 2, slab_y / 2) - height(slab.low, slab.tilted_low, slab_x / 2, slab_y / 2);
    return slab_x * slab_y * middle;
}

TEST(Neighbours, RoundedInTextBecomeTwoRegionsByTheLengthWithinWhichTheirSidesAgree) {
    const TemporaryFolder folder;
    const std::array<Rounding, 8> roundings{{{'f', 0}, {'f', 1}, {'f', 2}, {'f', 3}, {'g', 6}, {'g', 7}, {'s', 9}, {'s', 17}}};
    unsigned i = 0;
    for (const Rounding& rounding : roundings) {
        const double share = rounding.format == 'f' && rounding.digits == 0 ? 5e-3 : 1e-3;
        for (unsigned k = 0; k < 2; ++k) {
            const double turn = 0.41 * ++i;
            const Slab low{-500, -200, false, true, 2 + i % 5, 2 + i % 4}, high{-200, 0, true, false, 2 + i % 6, 3 + i % 7};
            write_file(folder / "in.ts", slab_text("low", low, rounding, turn) + slab_text("high", high, rounding, turn));
            const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
            ASSERT_EQ(run.status, 0) << rounding.format << rounding.digits << ' ' << turn << '\n' << run.out << run.err;
            const auto volumes = region_volumes(folder / "out.ml");
            ASSERT_EQ(volumes.size(), 2u) << rounding.format << rounding.digits << ' ' << turn << '\n' << run.out;
            EXPECT_NEAR(volumes[0], volume(high), share * volume(high)) << turn;
            EXPECT_NEAR(volumes[1], volume(low), share * volume(low)) << turn;
        }
    }
}

// A layer between the two that is three steps of the coordinates thick is no error of rounding: it stays, or nothing is written.
TEST(Neighbours, RoundedInTextKeepAThinLayerBetweenThem) {
    const TemporaryFolder folder;
    const Rounding rounding{'f', 3};
    for (const unsigned i : {1u, 3u}) {
        const double turn = 0.41 * i;
        const Slab low{-500, -200, false, true, 2 + i, 3 + i}, thin{-200, -199.997, true, true, 3 + i, 2},
            high{-199.997, 0, true, false, 2, 2 + i};
        write_file(folder / "in.ts", slab_text("low", low, rounding, turn) + slab_text("thin", thin, rounding, turn) +
                                         slab_text("high", high, rounding, turn));
        const auto run = run_geomend({"repair", folder / "in.ts", "-o", folder / "out.ml"});
        if (run.status == 6) continue;
        ASSERT_EQ(run.status, 0) << turn << '\n' << run.out << run.err;
        EXPECT_GE(region_volumes(folder / "out.ml").size(), 3u) << turn << '\n' << run.out;
    }
}

}  // namespace
}  // namespace geomend
