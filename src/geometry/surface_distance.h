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
    std::span<const std::uint32_t> groups() const { return groups_; }
    std::span<const std::uint32_t> around(std::uint32_t vertex) const { return around_.at(vertex); }
    std::array<Vec3, 3> corners(std::uint32_t t) const {
        const Triangle& v = tree_.triangle(t);
        return {vertices_[v[0]], vertices_[v[1]], vertices_[v[2]]};
    }

    /// Whether a triangle has a vertex.
    bool has(std::uint32_t t, std::uint32_t vertex) const {
        const Triangle& v = tree_.triangle(t);
        return v[0] == vertex || v[1] == vertex || v[2] == vertex;
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

    /// From a point on an edge p, q (or on a vertex: p = q) no triangle of a group there leads ahead in a direction: none of their
    /// other corners lies ahead of the point by more than rounding. \param direction across the edge, of any length but 0
    bool none_ahead(const Vec3& point, std::uint32_t p, std::uint32_t q, std::uint32_t group, const Vec3& direction) const;
    /// The same for a point on a part of a triangle (bits of corners as in Closest), and the triangle's group.
    bool none_ahead_at_part(const Vec3& point, std::uint32_t t, unsigned part, const Vec3& direction) const;

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
