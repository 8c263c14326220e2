// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.h"

namespace geomend::volumes {

/// A polyline that is to be a chain of edges of cells: a well, or any other line.
struct WellPath {
    std::string name;
    std::vector<Vec3> points;
};

/// Points that are the same where they lie within a distance of each other.
class PointPool {
public:
    explicit PointPool(double distance) : distance_(distance) {}

    /// The number of the nearest point within the distance, or no_index. Cost: that of the points around.
    std::uint32_t find(const Vec3& place) const;
    /// The same; a new one where there is none.
    std::uint32_t add(const Vec3& place);
    /// A new one, whatever lies near it.
    std::uint32_t add_new(const Vec3& place);
    /// A point changes its place. It is found there, and no longer where it was.
    void move(std::uint32_t number, const Vec3& place);

    const std::vector<Vec3>& places() const { return places_; }
    double distance() const { return distance_; }

private:
    using Cell = std::array<std::int64_t, 3>;
    Cell cell_of(const Vec3& place) const;
    double distance_;
    std::vector<Vec3> places_;
    std::map<Cell, std::vector<std::uint32_t>> in_cell_;
};

/// Chains of straight pieces between points of one pool, which meet at points only.
struct WellNetwork {
    PointPool pool;
    std::vector<std::vector<std::uint32_t>> chains;  ///< one for each path, points in the order in which it runs
};

/// Points along a straight piece: how far from its first end, from 0 to 1, and which.
using PointsAlong = std::vector<std::pair<double, std::uint32_t>>;

/// How far along the way from one point to another a third lies.
double share_along(const Vec3& from, const Vec3& to, const Vec3& point);

/// A chain with these points in its pieces. \param along for each piece
std::vector<std::uint32_t> with_points_along(std::span<const std::uint32_t> chain, std::vector<PointsAlong> along);

/// Paths as a network: points within the distance of each other are one, and pieces that pass within it have a point there.
/// Cost: n log n in pieces, and as those that lie near each other.
WellNetwork network_of(std::span<const WellPath> paths, double distance);

}  // namespace geomend::volumes
