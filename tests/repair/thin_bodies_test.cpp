// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

#include "base/number_text.h"
#include "support/program.h"

// Bodies that are thinner than four steps of a northing of millions in single precision, which are 2 m, but not than those of their
// heights.

namespace geomend {
namespace {

using test::info;
using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

constexpr int quads = 10;
constexpr double side = 300;

/// A point of the top (k = 1) or the bottom of a bent, tilted body at map coordinates, in single precision.
std::string point_text(int i, int j, int k, double thickness, double bend, double tilt) {
    const double x = side * i / quads, y = side * j / quads;
    const double z = bend * std::sin(0.02 * x) * std::cos(0.017 * y) + tilt * x + k * thickness;
    std::string text;
    for (const double v : {5e5 + x, 6e6 + y, -2000 + z}) text += number_text(static_cast<double>(static_cast<float>(v))) + ' ';
    return text + '\n';
}

/// A closed surface as a legacy VTK file.
std::string body_text(double thickness, double bend, double tilt) {
    constexpr int n = quads + 1;
    std::string points;
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) points += point_text(i, j, k, thickness, bend, tilt);
        }
    }
    std::size_t count = 0;
    std::ostringstream triangles;
    const auto at = [](int i, int j, int k) { return (k * n + j) * n + i; };
    const auto quad = [&](int a, int b, int c, int d) {
        triangles << "3 " << a << ' ' << b << ' ' << c << "\n3 " << a << ' ' << c << ' ' << d << '\n';
        count += 2;
    };
    for (int i = 0; i < quads; ++i) {
        for (int j = 0; j < quads; ++j) {
            quad(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
            quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
        }
        quad(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1));
        quad(at(i, quads, 0), at(i, quads, 1), at(i + 1, quads, 1), at(i + 1, quads, 0));
        quad(at(0, i, 0), at(0, i, 1), at(0, i + 1, 1), at(0, i + 1, 0));
        quad(at(quads, i, 0), at(quads, i + 1, 0), at(quads, i + 1, 1), at(quads, i, 1));
    }
    return "# vtk DataFile Version 3.0\nthin\nASCII\nDATASET POLYDATA\nPOINTS " + std::to_string(2 * n * n) + " float\n" + points +
           "POLYGONS " + std::to_string(count) + ' ' + std::to_string(4 * count) + '\n' + triangles.str();
}

TEST(ThinBodies, OfSinglePrecisionAtMapCoordinatesAreValidAndStayAsTheyAre) {
    const TemporaryFolder folder;
    for (const double thickness : {0.05, 0.3, 1.5}) {
        for (const double bend : {0.0, 8.0}) {
            for (const double tilt : {0.0, 0.4}) {
                const std::string about = std::to_string(thickness) + ' ' + std::to_string(bend) + ' ' + std::to_string(tilt);
                write_file(folder / "in.vtk", body_text(thickness, bend, tilt));
                const auto checked = run_geomend({"validate", folder / "in.vtk"});
                EXPECT_EQ(checked.status, 0) << about << '\n' << checked.out;
                EXPECT_NE(checked.out.find("tolerance 2 "), std::string::npos) << checked.out;
                const auto repaired = run_geomend({"repair", folder / "in.vtk", "-o", folder / "out.ml"});
                EXPECT_EQ(repaired.status, 0) << about << '\n' << repaired.out;
                const double volume = info(folder / "out.ml")["brep"]["region_volumes"][0]["volume"];
                EXPECT_NEAR(volume, side * side * thickness, 1e-3 * side * side) << about;  // four steps of the heights are 0.5 mm
            }
        }
    }
}

}  // namespace
}  // namespace geomend
