// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "geometry/triangle_pair.h"

namespace geomend {

/// Space with long empty stretches along its axes taken out, so that few cells and single precision serve what lies in several
/// places far from one another. Along each axis the order of points stays, and no two get farther apart: what overlaps or lies
/// within a distance before does so afterwards; some of what does not may, too.
class SqueezedSpace {
public:
    SqueezedSpace() = default;
    /// Takes out what no triangle reaches along an axis, where that is an eighth of the extent or more.
    /// \param low, high the extent. Cost: linear, some nanoseconds for each triangle; a few times that where something is taken out.
    SqueezedSpace(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3& low, const Vec3& high);

    double at(std::size_t axis, double x) const {
        for (const auto& gaps : rounds_[axis]) x = squeezed(gaps, x);
        return x;
    }

private:
    struct Gap {
        double from, to;  ///< all points in between come to lie at one place
        double place;     ///< where that is
        double shift;     ///< by which all that lies beyond moves down
    };
    using Round = std::vector<Gap>;  ///< ascending
    std::array<std::vector<Round>, 3> rounds_;

    static double squeezed(const Round& gaps, double x);
    static Round gaps_between(std::span<const int> starts, double low, double width);
};

}  // namespace geomend
