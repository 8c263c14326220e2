// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gridding/build_grid.h"

// Small structural models for tests, from functions of depth.

namespace geomend::gridding::test {

/// A map of nx by ny samples from the origin on, from a depth at (x,y).
template <class Depth>
Horizon map(const std::string& name, std::uint32_t nx, std::uint32_t ny, double step, const Depth& depth) {
    HorizonMap map{{nx, ny}, {0, 0}, {Point{step, 0}, Point{0, step}}, {}};
    for (std::uint32_t j = 0; j < ny; ++j) {
        for (std::uint32_t i = 0; i < nx; ++i) map.depths.push_back(depth(i * step, j * step));
    }
    return {name, std::move(map)};
}

/// Triangles over a lattice, cut along the line x = cut: depth(x, y, side) with side -1 left of it and +1 right.
template <class Depth>
Horizon cut_sheet(const std::string& name, std::uint32_t nx, std::uint32_t ny, double step, std::uint32_t cut, const Depth& depth) {
    Sheet sheet;
    const auto add = [&](std::uint32_t from, std::uint32_t to, int side) {
        const auto first = static_cast<std::uint32_t>(sheet.vertices.size());
        const std::uint32_t row = to - from + 1;
        for (std::uint32_t j = 0; j <= ny; ++j) {
            for (std::uint32_t i = from; i <= to; ++i) sheet.vertices.push_back({i * step, j * step, depth(i * step, j * step, side)});
        }
        for (std::uint32_t j = 0; j < ny; ++j) {
            for (std::uint32_t i = 0; i + 1 < row; ++i) {
                const std::uint32_t a = first + i + row * j;
                sheet.triangles.push_back({a, a + 1, a + row});
                sheet.triangles.push_back({a + 1, a + row + 1, a + row});
            }
        }
    };
    add(0, cut, -1);
    add(cut, nx, 1);
    return {name, std::move(sheet)};
}

/// An upright fault between two places.
inline Fault curtain(const std::string& name, const Point& a, const Point& b, double upper, double lower) {
    Fault fault{name, {a, b}, {}, {}, {}};
    fault.sheet.vertices = {{a[0], a[1], upper}, {b[0], b[1], upper}, {b[0], b[1], lower}, {a[0], a[1], lower}};
    fault.sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    return fault;
}

inline Net net(std::uint32_t nx, std::uint32_t ny, double dx, double dy, double rotation = 0, Point origin = {0, 0}) {
    return net_of({origin, rotation, {nx, ny}, {dx, dy}}, 0, 1);
}

inline ZoneLayers proportional(std::uint32_t n) { return {"", ZoneLayers::Rule::proportional, n, 0}; }

inline MadeGrid grid(const Structure& structure, const Net& net, std::vector<ZoneLayers> zones) {
    GridOptions options;
    options.zones = std::move(zones);
    auto made = build_grid(structure, net, options);
    EXPECT_TRUE(made.ok()) << (made ? "" : made.why().error.message);
    return made ? std::move(*made) : MadeGrid{};
}

}  // namespace geomend::gridding::test
