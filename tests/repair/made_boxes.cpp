// SPDX-License-Identifier: AGPL-3.0-or-later
#include "made_boxes.h"

#include <cstdio>
#include <random>
#include <utility>

#include "base/vectors.h"

namespace geomend::test {

std::string tsurf_text(const Sheet& sheet) {
    std::string text = "GOCAD TSurf 1\nHEADER {\nname: " + sheet.name + "\n}\n";
    if (!sheet.role.empty()) text += "GEOLOGICAL_FEATURE " + sheet.name + "\nGEOLOGICAL_TYPE " + sheet.role + "\n";
    text += "TFACE\n";
    char line[160];
    for (int i = 0; i <= sheet.n; ++i) {
        for (int j = 0; j <= sheet.n; ++j) {
            Vec3 p = plus(sheet.corner,
                          plus(times(static_cast<double>(i) / sheet.n, sheet.u), times(static_cast<double>(j) / sheet.n, sheet.v)));
            if (sheet.move) p = sheet.move(p);
            std::snprintf(line, sizeof line, "VRTX %d %.17g %.17g %.17g\n", i * (sheet.n + 1) + j + 1, p[0], p[1], p[2]);
            text += line;
        }
    }
    for (int i = 0; i < sheet.n; ++i) {
        for (int j = 0; j < sheet.n; ++j) {
            const int a = i * (sheet.n + 1) + j + 1, b = a + sheet.n + 1;
            std::snprintf(line, sizeof line, "TRGL %d %d %d\nTRGL %d %d %d\n", a, b, b + 1, a, b + 1, a + 1);
            text += line;
        }
    }
    return text + "END\n";
}

Sheet level(const std::string& name, double z, int n, double size) { return {name, {0, 0, z}, {size, 0, 0}, {0, size, 0}, n, "top", {}}; }

std::string box_text(double shaken, const std::string& role, double size) {
    std::string text;
    std::mt19937 engine(1);
    const auto shake = [&](const Vec3& p) {
        Vec3 moved = p;
        for (double& x : moved) x += shaken * (static_cast<double>(engine()) / 2147483648.0 - 1);
        return moved;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t high = 0; high < 2; ++high) {
            Sheet side;
            side.name = "side_" + std::to_string(2 * axis + high);
            side.role = role;
            side.corner[axis] = high != 0 ? size : 0;
            side.u[(axis + 1) % 3] = side.v[(axis + 2) % 3] = size;
            if (high == 0) std::swap(side.u, side.v);
            if (shaken > 0) side.move = shake;
            text += tsurf_text(side);
        }
    }
    return text;
}

}  // namespace geomend::test
