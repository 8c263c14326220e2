// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace geomend::arrangement {

/// Points that keep a distance from each other: one that is added closer than that to another becomes that one, to the
/// nearest where there are several. So no chain of near points draws one far away, and the order of adding decides who stays.
class SpacedPoints {
public:
    /// \param distance above 0
    /// \param expected number of points for which room is made
    SpacedPoints(double distance, std::size_t expected);

    /// The number of the point: of an earlier one, where one is closer than the distance. Constant time where few are near.
    std::uint32_t add(const Vec3& point) { return add(point, distance_); }
    /// The same, where it need be farther than `distance` from others, up to 32 times the usual one.
    std::uint32_t add(const Vec3& point, double distance);
    /// Moves points, so that those which come closer than the distance to another become that one, which stays itself: per point the one
    /// that it is now. All keep their numbers; those that are others now, and those that nobody uses, are found no more. Linear in all
    /// points.
    struct Move {
        std::uint32_t point;
        Vec3 to;
    };
    std::vector<std::uint32_t> move(const std::vector<Move>& moves, const std::vector<std::uint8_t>& is_used);
    const std::vector<Vec3>& points() const { return points_; }
    double distance() const { return distance_; }

private:
    double distance_, cell_;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> next_;  ///< of a point, the one before it in its cell
    std::vector<std::uint64_t> keys_;  ///< open addressing: cell, and its newest point
    std::vector<std::uint32_t> heads_;
    std::size_t cells_ = 0, mask_ = 0;

    std::size_t slot_of(std::uint64_t key) const;
    void grow();
    std::uint32_t nearest(const Vec3& point, double distance) const;
    void enter(std::uint32_t number);
};

}  // namespace geomend::arrangement
