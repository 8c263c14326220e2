// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/triangle_pair.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"
#include "geometry/predicates.h"

namespace geomend {

namespace {

using Edge = std::array<std::uint32_t, 2>;

/// The point of the segment p, q at share t.
Vec3 between(const Vec3& p, const Vec3& q, double t) {
    if (t > 0.5) return plus(q, times(1 - t, minus(p, q)));
    return plus(p, times(t, minus(q, p)));
}

double squared_distance(const Vec3& a, const Vec3& b) {
    const Vec3 d = minus(a, b);
    return dot(d, d);
}

/// The edge of a feature, from its lower vertex number.
Edge edge_at(const Triangle& t, TriangleFeature edge) {
    const std::uint32_t p = t[index_of(edge)], q = t[(index_of(edge) + 1) % 3];
    return {std::min(p, q), std::max(p, q)};
}

class Places {
public:
    Places(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b) : vertices_(vertices), a_(a), b_(b) {}

    /// \pre the triangles lie in different planes, or the point is a corner
    Vec3 place(const ContactPoint& p) const {
        if (is_corner(p.on_a)) return at(a_[index_of(p.on_a)]);
        if (is_corner(p.on_b)) return at(b_[index_of(p.on_b)]);
        if (p.on_b == TriangleFeature::face) return pierced(edge_at(a_, p.on_a), b_);
        if (p.on_a == TriangleFeature::face) return pierced(edge_at(b_, p.on_b), a_);
        // Edges cross: the same one is taken for either order of a and b, but none that lies in the other's plane.
        const Edge of_a = edge_at(a_, p.on_a), of_b = edge_at(b_, p.on_b);
        const bool a_first = of_a < of_b;
        const Edge& first = a_first ? of_a : of_b;
        if (passes(first, a_first ? b_ : a_)) return pierced(first, a_first ? b_ : a_);
        return a_first ? pierced(of_b, a_) : pierced(of_a, b_);
    }

    std::array<Vec3, 2> longest_extent(const Contact& overlap) const {
        const unsigned axis = main_axis(at(a_[0]), at(a_[1]), at(a_[2]));
        std::array<Vec3, 6> corners{};
        std::size_t n = 0;
        for (unsigned next = 0; next < ranks; ++next) {
            for (const ContactPoint& p : overlap.points()) {
                if (rank(p) == next) corners[n++] = next < crossings ? place(p) : in_plane(p, axis);
            }
        }
        return farthest({corners.data(), n});
    }

private:
    std::span<const Vec3> vertices_;
    const Triangle &a_, &b_;

    const Vec3& at(std::uint32_t vertex) const { return vertices_[vertex]; }

    bool passes(const Edge& edge, const Triangle& plane) const {
        const auto side = [&](std::uint32_t v) { return orientation(at(plane[0]), at(plane[1]), at(plane[2]), at(v)); };
        return side(edge[0]) * side(edge[1]) < 0;
    }

    /// Where an edge passes a plane. The plane is taken in ascending order, too, so that all pairs of triangles with this edge
    /// and this plane get the same bits.
    Vec3 pierced(const Edge& edge, Triangle plane) const {
        std::sort(plane.begin(), plane.end());
        const double start = std::abs(six_volumes(at(plane[0]), at(plane[1]), at(plane[2]), at(edge[0])));
        const double stop = std::abs(six_volumes(at(plane[0]), at(plane[1]), at(plane[2]), at(edge[1])));
        return between(at(edge[0]), at(edge[1]), start / (start + stop));
    }

    /// Where two edges in one plane cross.
    Vec3 in_plane(const ContactPoint& crossed, unsigned axis) const {
        const unsigned i = index_of(crossed.on_a), j = index_of(crossed.on_b);
        const Vec3 &p = at(a_[i]), &q = at(a_[(i + 1) % 3]), &r = at(b_[j]), &s = at(b_[(j + 1) % 3]);
        const auto area = [&](const Vec3& x) { return std::abs(cross(minus(s, r), minus(x, r))[axis]); };
        const double start = area(p), stop = area(q);
        return start + stop > 0 ? between(p, q, start / (start + stop)) : p;
    }

    /// Corners of a come before those of b, and both before crossings: of equal extents the same one is taken wherever a walk
    /// around the polygon begins.
    static constexpr unsigned crossings = 6, ranks = 15;
    static unsigned rank(const ContactPoint& p) {
        if (is_corner(p.on_a)) return index_of(p.on_a);
        if (is_corner(p.on_b)) return 3 + index_of(p.on_b);
        return crossings + 3 * index_of(p.on_a) + index_of(p.on_b);
    }

    static std::array<Vec3, 2> farthest(std::span<const Vec3> points) {
        std::array<Vec3, 2> found{points.front(), points.front()};
        for (const Vec3& p : points) {
            for (const Vec3& q : points) {
                if (squared_distance(p, q) > squared_distance(found[0], found[1])) found = {p, q};
            }
        }
        return found;
    }
};

}  // namespace

TriangleMeeting meeting(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b) {
    const Contact how = contact(vertices, a, b);
    const Places places(vertices, a, b);
    switch (how.kind) {
        case Meeting::none:
            return {};
        case Meeting::point: {
            const Vec3 p = places.place(how.corners[0]);
            return {Meeting::point, {p, p}};
        }
        case Meeting::overlap:
            return {Meeting::overlap, places.longest_extent(how)};
        default:
            return {how.kind, {places.place(how.corners[0]), places.place(how.corners[1])}};
    }
}

}  // namespace geomend
