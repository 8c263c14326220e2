// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "base/vec3.h"
#include "geometry/vectors.h"

namespace geomend {

/// Bit i stands for corner i of a triangle.
using Corners = unsigned;

/// A triangle made ready for many cheap tests whether others keep clear of it.
///
/// Two triangles meet in nothing but their shared corners where a plane through these has the other corners of one strictly on
/// one side and the other triangle on the other side or in the plane. Tried are the triangle's own plane and the planes through its
/// edges along the axis that its normal follows most: for neighbours in a surface one of these nearly always does; and through a
/// shared corner the plane across the direction in which the triangle leaves it, for neighbours on the lines of its edges. The signs are
/// taken in plain arithmetic, and only where they are larger than all rounding: "yes" is exact, "no" only means unsure.
class Separator {
public:
    explicit Separator(const std::array<Vec3, 3>& corners) : corner_(corners) {
        const Vec3 u = minus(corner_[1], corner_[0]), v = minus(corner_[2], corner_[0]);
        normal_ = cross(u, v);
        reach_ = std::max(largest(u), largest(v));
        axis_ = std::abs(normal_[0]) > std::abs(normal_[1]) ? 0 : 1;
        if (std::abs(normal_[2]) > std::abs(normal_[axis_])) axis_ = 2;
        if (std::abs(normal_[axis_]) > area_error * reach_ * reach_) turn_ = normal_[axis_] > 0 ? 1 : -1;
    }

    const std::array<Vec3, 3>& corners() const { return corner_; }

    /// \param own, its which corners the two share, of this and of the other; not all three
    bool clear_of(const std::array<Vec3, 3>& other, Corners own, Corners its) const {
        return clear_of_edge_planes(other, own, its) || clear_of_plane(other, its) || clear_across_corner(other, own, its);
    }

private:
    std::array<Vec3, 3> corner_;
    Vec3 normal_{};
    double reach_ = 0;  ///< largest coordinate difference from corner 0
    std::size_t axis_ = 0;
    double turn_ = 0;  ///< sign of the normal along the axis, 0 where rounding leaves it open

    // Sums of sizes are replaced by products of the largest differences. Two terms of four roundings: 8 * 2^-53 = 9e-16 for
    // areas; six terms of eight roundings: 48 * 2^-53 = 5.4e-15 for volumes.
    static constexpr double length_error = 2e-15;  // three terms of four roundings: 1.4e-15
    static constexpr double area_error = 1e-15;
    static constexpr double volume_error = 6e-15;

    static double largest(const Vec3& d) { return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}); }

    /// The other's corners that are not shared lie all strictly on one side of the plane.
    bool clear_of_plane(const std::array<Vec3, 3>& other, Corners its) const {
        double lowest = HUGE_VAL, highest = -HUGE_VAL, reach = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if ((its >> i & 1u) != 0) continue;
            const Vec3 w = minus(other[i], corner_[0]);
            const double side = dot(normal_, w);
            lowest = std::min(lowest, side);
            highest = std::max(highest, side);
            reach = std::max(reach, largest(w));
        }
        const double error = volume_error * reach_ * reach_ * reach;
        return lowest > error || highest < -error;
    }

    /// The other's corners that are not shared lie all strictly beyond the plane through an edge that has all shared corners.
    bool clear_of_edge_planes(const std::array<Vec3, 3>& other, Corners own, Corners its) const {
        if (turn_ == 0) return false;
        const std::size_t x = axis_ == 2 ? 0 : axis_ + 1, y = axis_ == 0 ? 2 : axis_ - 1;
        for (unsigned i = 0; i < 3; ++i) {
            const unsigned j = i == 2 ? 0 : i + 1;
            if ((own & ~(1u << i | 1u << j)) != 0) continue;
            const Vec3 &p = corner_[i], &q = corner_[j];
            const double ex = turn_ * (q[x] - p[x]), ey = turn_ * (q[y] - p[y]);
            double highest = -HUGE_VAL, reach = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                if ((its >> k & 1u) != 0) continue;
                const double dx = other[k][x] - p[x], dy = other[k][y] - p[y];
                highest = std::max(highest, ex * dy - ey * dx);
                reach = std::max({reach, std::abs(dx), std::abs(dy)});
            }
            if (highest < -area_error * std::max(std::abs(ex), std::abs(ey)) * reach) return true;
        }
        return false;
    }

    /// A single shared corner: the triangle leaves it on one side of a plane, the other one on the other.
    bool clear_across_corner(const std::array<Vec3, 3>& other, Corners own, Corners its) const {
        if (own == 0 || (own & (own - 1)) != 0) return false;
        const auto shared = static_cast<std::size_t>(std::countr_zero(own));
        const Vec3& p = corner_[shared];
        const Vec3 u = minus(corner_[(shared + 1) % 3], p), v = minus(corner_[(shared + 2) % 3], p);
        const Vec3 ahead = plus(u, v);  // any direction would do
        double reach = 0, highest = -HUGE_VAL;
        for (std::size_t k = 0; k < 3; ++k) {
            if ((its >> k & 1u) != 0) continue;
            const Vec3 w = minus(other[k], p);
            highest = std::max(highest, dot(ahead, w));
            reach = std::max(reach, largest(w));
        }
        const double error = length_error * largest(ahead);
        return highest < -error * reach && std::min(dot(ahead, u), dot(ahead, v)) > error * std::max(largest(u), largest(v));
    }
};

}  // namespace geomend
