// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/closest_points.h"
#include "geometry/triangle_tree.h"
#include "geometry/vertex_triangles.h"

namespace geomend {

/// Questions about distances between the surfaces (groups of triangles) of a soup. Triangles are named by their place in the
/// tree's order, so that degenerate ones are left out and neighbours lie side by side in memory.
class SurfaceDistance {
public:
    /// \param groups of the triangles as they are numbered in the soup
    SurfaceDistance(const TriangleTree& tree, std::span<const std::uint32_t> groups);

    const TriangleTree& tree() const { return tree_; }
    std::span<const Vec3> positions() const { return vertices_; }
    const Vec3& position(std::uint32_t vertex) const { return vertices_[vertex]; }
    const Triangle& triangle(std::uint32_t t) const { return tree_.triangle(t); }
    std::uint32_t group(std::uint32_t t) const { return groups_[t]; }
    std::span<const std::uint32_t> around(std::uint32_t vertex) const { return around_.at(vertex); }
    std::array<Vec3, 3> corners(std::uint32_t t) const {
        const Triangle& v = tree_.triangle(t);
        return {vertices_[v[0]], vertices_[v[1]], vertices_[v[2]]};
    }

    bool on_group(std::uint32_t vertex, std::uint32_t group) const;
    /// The groups of the triangles around a vertex, ascending.
    std::vector<std::uint32_t> groups_at(std::uint32_t vertex) const;

    /// The triangles of a group around the part of a triangle that a point lies on (bits of corners as in Closest): those that
    /// have all these corners.
    std::vector<std::uint32_t> around_part(std::uint32_t t, unsigned part, std::uint32_t group) const;
    std::vector<std::uint32_t> around_edge(std::uint32_t p, std::uint32_t q, std::uint32_t group) const;

    /// The groups of all triangles around such a part.
    std::vector<std::uint32_t> groups_around_part(std::uint32_t t, unsigned part) const;

    /// No triangle of a list comes closer to the point than `distance`, apart from rounding.
    bool none_closer(const Vec3& point, std::span<const std::uint32_t> list, double distance) const;

    /// The point of a group that is closest to a point, and its triangle; distance HUGE_VAL
    /// where there is none within `near`.
    Closest from_group(const Vec3& point, std::uint32_t group, double near, std::uint32_t& triangle) const;

    /// Whether a vertex that has triangles of both groups lies within a distance of the point.
    bool common_vertex_within(double distance, const Vec3& point, std::uint32_t group_a, std::uint32_t group_b) const;

    /// What counts as equal distances: coordinates are known to so much only.
    double rounding(const Vec3& point) const;

private:
    const TriangleTree& tree_;
    std::span<const Vec3> vertices_;
    std::vector<std::uint32_t> groups_;
    VertexTriangles around_;
};

}  // namespace geomend
