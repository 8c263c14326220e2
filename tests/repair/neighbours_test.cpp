// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/number_text.h"
#include "base/vec3.h"
#include "support/program.h"

// Closed bodies beside each other, each in a file of its own in single precision: their common side is not the same in both.

namespace geomend {
namespace {

using test::info;
using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

constexpr double side = 100;

/// A place of two cubes in a row, turned about two axes, in single precision.
Vec3 placed(const Vec3& p, double turn) {
    const double c = std::cos(turn), s = std::sin(turn), d = std::cos(0.3 * turn), e = std::sin(0.3 * turn);
    const Vec3 q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
    const Vec3 r{4000 + q[0], 6000 + d * q[1] - e * q[2], -900 + e * q[1] + d * q[2]};
    return {static_cast<float>(r[0]), static_cast<float>(r[1]), static_cast<float>(r[2])};
}

/// A cube as a legacy VTK file; the sides of the second one are split along other diagonals, and it is a quarter longer across.
std::string cube_text(bool second, double turn) {
    const double low = second ? side : 0, wide = second ? 1.25 * side : side;
    std::string text = "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n";
    for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 p = placed({low + ((i & 1U) != 0 ? side : 0), (i & 2U) != 0 ? wide : 0, (i & 4U) != 0 ? side : 0}, turn);
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

}  // namespace
}  // namespace geomend
