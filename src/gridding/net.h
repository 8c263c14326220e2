// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridding/plan.h"
#include "model/corner_point.h"

namespace geomend::gridding {

/// The pillars of a grid. Pillar (i,j) is number i + (nx+1) j.
struct Net {
    std::array<std::uint32_t, 2> cells{0, 0};  ///< nx, ny
    std::vector<double> lines;                 ///< six values a pillar: x y z of an upper and a lower point, z is depth

    std::size_t pillar(std::size_t i, std::size_t j) const { return i + (std::size_t{cells[0]} + 1) * j; }
    std::size_t pillar_count() const { return (std::size_t{cells[0]} + 1) * (std::size_t{cells[1]} + 1); }
    std::size_t column(std::size_t i, std::size_t j) const { return i + std::size_t{cells[0]} * j; }
    std::size_t column_count() const { return std::size_t{cells[0]} * cells[1]; }
    /// Where a pillar is at a depth.
    Point at(std::size_t pillar, double depth) const {
        const double* p = lines.data() + 6 * pillar;
        if (p[0] == p[3] && p[1] == p[4]) return {p[0], p[1]};
        const Vec3 q = pillar_point(p, depth);
        return {q[0], q[1]};
    }
    bool is_outermost(std::size_t pillar) const {
        const std::size_t row = std::size_t{cells[0]} + 1, i = pillar % row, j = pillar / row;
        return i == 0 || j == 0 || i == cells[0] || j == cells[1];
    }
    bool is_upright(std::size_t pillar) const {
        const double* p = lines.data() + 6 * pillar;
        return p[0] == p[3] && p[1] == p[4];
    }
};

/// A regular frame: columns of one size in rows along I, which is `rotation` degrees to the left of the x axis; J is to the left of I.
struct Frame {
    Point origin{};
    double rotation = 0;
    std::array<std::uint32_t, 2> cells{0, 0};
    std::array<double, 2> size{0, 0};
};

/// Upright pillars between two depths.
Net net_of(const Frame& frame, double upper, double lower);

/// The direction that a length of lines most often has, in degrees from 0 to 90: lines at right angles count as one direction. 0 where
/// there are none.
double dominant_strike(const std::vector<Path>& lines);

/// The box around points with a side in a direction: its first corner and its two sizes.
struct TurnedBox {
    Point origin{};
    std::array<double, 2> size{0, 0};
};
TurnedBox box_around(const std::vector<Point>& points, double rotation);

/// The rotation of the smallest box around points, 0 to 90, and how much of its area their convex hull fills.
struct SmallestBox {
    double rotation = 0, share = 0;
};
SmallestBox smallest_box(const std::vector<Point>& points);

/// The ring of the outermost pillars at a depth.
Path outline_of(const Net& net, double depth);

/// The mean length of an edge between neighbouring pillars at a depth.
double spacing_of(const Net& net, double depth);

}  // namespace geomend::gridding
