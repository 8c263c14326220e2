// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "topology/model_maker.h"

namespace geomend::testing {

/// A sealed box of 4 x 3 x 2 with two bent horizons and a vertical fault through all: six regions, all surfaces of many
/// triangles, normals of the skin outwards, horizons up, fault to larger x.
struct LayeredModel {
    test::ModelMaker maker;

    static constexpr int nx = 6, ny = 4, sheets = 4;  // quadrangles along x and y; bottom, two horizons, top
    static constexpr int fault = 3;                   // column of nodes that the fault stands on

    static Vec3 node(int i, int j, int sheet) {
        const double x = 4.0 * i / nx, y = 3.0 * j / ny;
        const double bend = sheet == 0 || sheet == sheets - 1 ? 0 : 0.08 * std::sin(1.7 * x + sheet) + 0.06 * std::cos(2.1 * y);
        return {x, y, 2.0 * sheet / (sheets - 1) + bend};
    }

    LayeredModel() {
        using test::Triangle;
        const auto sheet = [&](int s, int from, int to, bool up) {
            std::vector<Triangle> t;
            for (int i = from; i < to; ++i) {
                for (int j = 0; j < ny; ++j) {
                    const Vec3 a = node(i, j, s), b = node(i + 1, j, s), c = node(i + 1, j + 1, s), d = node(i, j + 1, s);
                    const auto q = up ? test::quad(a, b, c, d) : test::quad(a, d, c, b);
                    t.insert(t.end(), q.begin(), q.end());
                }
            }
            return t;
        };
        // A wall between two sheets along x (at some j) or along y (at some i); normals to the right of the way.
        const auto wall = [&](int s, std::vector<std::array<int, 2>> way) {
            std::vector<Triangle> t;
            for (std::size_t k = 0; k + 1 < way.size(); ++k) {
                const auto [i, j] = way[k];
                const auto [u, v] = way[k + 1];
                const auto q = test::quad(node(i, j, s), node(u, v, s), node(u, v, s + 1), node(i, j, s + 1));
                t.insert(t.end(), q.begin(), q.end());
            }
            return t;
        };
        const auto along_x = [](int j, int from, int to) {
            std::vector<std::array<int, 2>> way;
            for (int i = from; i != to; i += from < to ? 1 : -1) way.push_back({i, j});
            way.push_back({to, j});
            return way;
        };
        const auto along_y = [](int i, int from, int to) {
            std::vector<std::array<int, 2>> way;
            for (int j = from; j != to; j += from < to ? 1 : -1) way.push_back({i, j});
            way.push_back({i, to});
            return way;
        };
        const auto both = [&](int s, bool up) { return std::vector{sheet(s, 0, fault, up), sheet(s, fault, nx, up)}; };
        std::vector<std::vector<Triangle>> south, north, west, east, middle;
        for (int s = 0; s + 1 < sheets; ++s) {
            south.push_back(wall(s, along_x(0, 0, fault)));
            south.push_back(wall(s, along_x(0, fault, nx)));
            north.push_back(wall(s, along_x(ny, fault, 0)));
            north.push_back(wall(s, along_x(ny, nx, fault)));
            west.push_back(wall(s, along_y(0, ny, 0)));
            east.push_back(wall(s, along_y(nx, 0, ny)));
            middle.push_back(wall(s, along_y(fault, 0, ny)));
        }
        const auto bottom = maker.add_parts("bottom", FeatureRole::boundary, both(0, false));
        const auto lower = maker.add_parts("lower", FeatureRole::horizon, both(1, true));
        const auto upper = maker.add_parts("upper", FeatureRole::horizon, both(2, true));
        const auto top = maker.add_parts("top", FeatureRole::boundary, both(3, true));
        const auto s = maker.add_parts("south", FeatureRole::boundary, south);
        const auto n = maker.add_parts("north", FeatureRole::boundary, north);
        const auto w = maker.add_parts("west", FeatureRole::boundary, west);
        const auto e = maker.add_parts("east", FeatureRole::boundary, east);
        const auto f = maker.add_parts("fault", FeatureRole::fault, middle);
        StatedModel::Region universe;
        universe.name = "Universe";
        universe.universe = true;
        maker.model().regions.push_back(universe);
        for (std::uint32_t layer = 0; layer < 3; ++layer) {
            for (std::uint32_t block = 0; block < 2; ++block) {
                StatedModel::Region r;
                r.name = "block_" + std::to_string(layer) + std::to_string(block);
                const auto floor = layer == 0 ? bottom : layer == 1 ? lower : upper;
                const auto roof = layer == 0 ? lower : layer == 1 ? upper : top;
                r.sides.push_back({floor[block], layer != 0});  // the bottom's normal points out
                r.sides.push_back({roof[block], false});
                r.sides.push_back({s[2 * layer + block], false});
                r.sides.push_back({n[2 * layer + block], false});
                r.sides.push_back({block == 0 ? w[layer] : e[layer], false});
                r.sides.push_back({f[layer], block == 1});  // its normal points to larger x
                maker.model().regions.push_back(r);
                for (const auto& side : r.sides) {
                    const auto& face = maker.model().faces[side.face];
                    if (face.role == FeatureRole::boundary) maker.model().regions[0].sides.push_back({side.face, !side.front});
                }
            }
        }
        for (std::uint32_t layer = 0; layer < 3; ++layer)
            maker.model().layers.push_back({"layer_" + std::to_string(layer), {1 + 2 * layer, 2 + 2 * layer}, {}});
    }

    Dataset& data() { return maker.data; }
    Surface& surface(const std::string& name) {
        for (Object& object : maker.data.objects) {
            if (info_of(object).name == name) return std::get<Surface>(object);
        }
        throw std::out_of_range(name);
    }
};

/// Names of the objects of a LayeredModel.
inline const std::vector<std::string>& layered_names() {
    static const std::vector<std::string> names = {"bottom", "lower", "upper", "top", "south", "north", "west", "east", "fault"};
    return names;
}

/// Number of the first polygon of each part, and the end.
inline std::vector<std::uint64_t> part_bounds(const Surface& surface) {
    std::vector<std::uint64_t> bounds;
    for (const auto& part : surface.parts) bounds.push_back(part.first_polygon);
    if (bounds.empty()) bounds.push_back(0);
    bounds.push_back(surface.polygons.size());
    return bounds;
}

/// Puts points and triangles into the last part of a surface, so that the earlier parts keep their numbers.
inline std::uint32_t add_point(Surface& surface, const Vec3& p) {
    surface.points.push_back(p);
    return static_cast<std::uint32_t>(surface.points.size() - 1);
}
inline void add_triangle(Surface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::array<std::uint32_t, 3> t{a, b, c};
    surface.polygons.push_back(t);
}

}  // namespace geomend::testing
