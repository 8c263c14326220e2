// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/triangle_pair.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "geometry/predicates.h"
#include "geometry/vectors.h"

// Two triangles in different planes meet on the line of these planes, where each has an interval. The order of the ends of
// the intervals is that of four-point orientations: P. Guigue and O. Devillers, "Fast and robust triangle-triangle overlap
// test using orientation predicates" (2003). Here the ends are found from the signs in cyclic order, so that vertices and
// edges in the other plane need no cases of their own.

namespace geomend {

namespace {

constexpr unsigned nothing = 3;  // in place of a corner 0..2

/// On which side of the other triangle's plane the corners lie.
using Sides = std::array<int, 3>;

/// Where the border of a triangle passes the other plane: the edge between a corner that is lower and one that is higher.
/// Where one of them lies in the plane, it is the end.
struct End {
    unsigned low, high;
};

bool same_side(const Sides& s) {
    const auto [low, high] = std::minmax({s[0], s[1], s[2]});
    return low > 0 || high < 0;
}

long zeros(const Sides& s) { return std::count(s.begin(), s.end(), 0); }

/// The triangle has no more than a corner in the plane.
bool touches_at_a_corner(const Sides& s) { return zeros(s) == 1 && s[0] + s[1] + s[2] != 0; }

/// The end at which the border comes up through the plane, and the one at which it goes down. \pre not all equal
End rising(const Sides& s) {
    for (unsigned i = 0; i < 2; ++i) {
        if (s[i + 1] > s[i]) return {i, i + 1};
    }
    return {2, 0};
}
End falling(const Sides& s) {
    for (unsigned i = 0; i < 2; ++i) {
        if (s[i + 1] < s[i]) return {i + 1, i};
    }
    return {0, 2};
}

/// The corner that an end is, or nothing.
unsigned corner_at(const Sides& s, End end) { return s[end.low] == 0 ? end.low : s[end.high] == 0 ? end.high : nothing; }

double squared_distance(const Vec3& a, const Vec3& b) {
    const Vec3 d = minus(a, b);
    return dot(d, d);
}

/// The point of the segment p, q at share t.
Vec3 between(const Vec3& p, const Vec3& q, double t) {
    if (t > 0.5) return plus(q, times(1 - t, minus(p, q)));
    return plus(p, times(t, minus(q, p)));
}

class TwoTriangles {
public:
    TwoTriangles(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b) : vertices_(vertices), a_(a), b_(b) {
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) {
                if (a_[i] != b_[j]) continue;
                a_shared_[i] = b_shared_[j] = true;
                ++shared_;
            }
        }
    }

    TriangleMeeting answer() const {
        if (shared_ == 3) return {Meeting::overlap, longest_extent()};
        const Sides b_sides = sides(b_, b_shared_, a_);
        if (same_side(without_shared(b_sides, b_shared_))) return {};
        if (zeros(b_sides) == 3) return in_one_plane();
        const Sides a_sides = sides(a_, a_shared_, b_);
        if (same_side(without_shared(a_sides, a_shared_))) return {};
        return across(a_sides, b_sides);
    }

private:
    std::span<const Vec3> vertices_;
    const Triangle a_, b_;
    std::array<bool, 3> a_shared_{}, b_shared_{};
    unsigned shared_ = 0;

    const Vec3& at(std::uint32_t vertex) const { return vertices_[vertex]; }

    Sides sides(const Triangle& of, const std::array<bool, 3>& shared, const Triangle& plane) const {
        Sides s{};
        for (unsigned i = 0; i < 3; ++i) {
            if (!shared[i]) s[i] = orientation(at(plane[0]), at(plane[1]), at(plane[2]), at(of[i]));
        }
        return s;
    }

    /// Shared corners lie in both planes and decide nothing: they count as lying with the others.
    static Sides without_shared(Sides s, const std::array<bool, 3>& shared) {
        int other = 0;
        for (unsigned i = 0; i < 3; ++i) {
            if (!shared[i]) other = s[i];
        }
        for (unsigned i = 0; i < 3; ++i) {
            if (shared[i]) s[i] = other;
        }
        return s;
    }

    // ---- different planes

    /// Sign of the place of an end of b minus that of an end of a along the line, in the direction of normal a x normal b.
    int along(End of_a, End of_b) const {
        const std::uint32_t p = a_[of_a.high], q = a_[of_a.low], r = b_[of_b.high], s = b_[of_b.low];
        if (p == r || p == s || q == r || q == s) return 0;  // the shared vertex is both ends
        return orientation(at(p), at(q), at(r), at(s));
    }

    TriangleMeeting across(const Sides& a_sides, const Sides& b_sides) const {
        const End a_first = rising(a_sides), a_last = falling(a_sides);
        const End b_first = falling(b_sides), b_last = rising(b_sides);
        const int b_begins = along(a_last, b_first), b_ends = along(a_first, b_last);
        if (b_begins > 0 || b_ends < 0) return {};
        const auto place_a = [&](End end) { return place(a_, a_sides, end, b_); };
        const auto place_b = [&](End end) { return place(b_, b_sides, end, a_); };
        // Where two ends fall together: a corner where one is; else edges cross, and the same edge is taken for either order of a and b.
        const auto common_place = [&](End of_a, End of_b) {
            if (corner_at(a_sides, of_a) != nothing) return place_a(of_a);
            if (corner_at(b_sides, of_b) != nothing) return place_b(of_b);
            return edge(a_, of_a) < edge(b_, of_b) ? place_a(of_a) : place_b(of_b);
        };
        const auto point = [&](const Vec3& p) { return shared_ > 0 ? TriangleMeeting{} : TriangleMeeting{Meeting::point, {p, p}}; };
        if (touches_at_a_corner(a_sides)) return point(place_a(a_first));
        if (touches_at_a_corner(b_sides)) return point(place_b(b_first));
        if (b_begins == 0) return point(common_place(a_last, b_first));
        if (b_ends == 0) return point(common_place(a_first, b_last));

        const int first = along(a_first, b_first), last = along(a_last, b_last);
        TriangleMeeting found;
        found.kind = zeros(a_sides) == 2 || zeros(b_sides) == 2 ? Meeting::touch : Meeting::crossing;
        found.segment[0] = first > 0 ? place_b(b_first) : first < 0 ? place_a(a_first) : common_place(a_first, b_first);
        found.segment[1] = last < 0 ? place_b(b_last) : last > 0 ? place_a(a_last) : common_place(a_last, b_last);
        return found;
    }

    static std::array<std::uint32_t, 2> edge(const Triangle& of, End end) {
        return {std::min(of[end.low], of[end.high]), std::max(of[end.low], of[end.high])};
    }

    /// Where an end lies. The edge is taken from its lower vertex number and the plane in ascending order, so that all pairs
    /// of triangles with this edge and this plane get the same bits.
    Vec3 place(const Triangle& of, const Sides& s, End end, Triangle plane) const {
        const unsigned corner = corner_at(s, end);
        if (corner != nothing) return at(of[corner]);
        const auto [from, to] = edge(of, end);
        std::sort(plane.begin(), plane.end());
        const double start = std::abs(six_volumes(at(plane[0]), at(plane[1]), at(plane[2]), at(from)));
        const double stop = std::abs(six_volumes(at(plane[0]), at(plane[1]), at(plane[2]), at(to)));
        return between(at(from), at(to), start / (start + stop));
    }

    // ---- one plane: the axis is dropped along which both have the most area

    unsigned axis_to_drop() const {
        const Vec3 n = cross(minus(at(a_[1]), at(a_[0])), minus(at(a_[2]), at(a_[0])));
        std::array<unsigned, 3> axes{0, 1, 2};
        std::sort(axes.begin(), axes.end(), [&](unsigned i, unsigned j) { return std::abs(n[i]) > std::abs(n[j]); });
        for (const unsigned axis : axes) {
            if (orientation_2d(at(a_[0]), at(a_[1]), at(a_[2]), axis) != 0) return axis;
        }
        return axes[0];
    }

    TriangleMeeting in_one_plane() const {
        const unsigned axis = axis_to_drop();
        if (shared_ == 2) return about_an_edge(axis);
        if (const auto found = beside(a_, b_, axis)) return *found;
        if (const auto found = beside(b_, a_, axis)) return *found;
        return {Meeting::overlap, longest_extent(axis)};
    }

    /// A shared edge: the triangles overlap where their third corners lie on the same side of it.
    TriangleMeeting about_an_edge(unsigned axis) const {
        std::array<std::uint32_t, 2> edge{};
        std::uint32_t third_a = 0, third_b = 0;
        for (unsigned i = 0, n = 0; i < 3; ++i) {
            if (a_shared_[i]) edge[n++] = a_[i];
            else third_a = a_[i];
            if (!b_shared_[i]) third_b = b_[i];
        }
        const int side_a = orientation_2d(at(edge[0]), at(edge[1]), at(third_a), axis);
        const int side_b = orientation_2d(at(edge[0]), at(edge[1]), at(third_b), axis);
        if (side_a != side_b) return {};
        return {Meeting::overlap, longest_extent(axis)};
    }

    /// Of which side of the edge i, i+1 of t a vertex lies: +1 where the triangle is.
    int inside(const Triangle& t, unsigned i, std::uint32_t vertex, unsigned axis) const {
        const std::uint32_t p = t[i], q = t[(i + 1) % 3];
        if (vertex == p || vertex == q) return 0;
        return orientation_2d(at(t[0]), at(t[1]), at(t[2]), axis) * orientation_2d(at(p), at(q), at(vertex), axis);
    }

    /// What they have in common where an edge of t has all of the other beyond it or on its line; nothing where no edge has.
    std::optional<TriangleMeeting> beside(const Triangle& t, const Triangle& other, unsigned axis) const {
        for (unsigned i = 0; i < 3; ++i) {
            std::vector<std::uint32_t> on_line;
            bool beyond = true;
            for (const std::uint32_t vertex : other) {
                const int side = inside(t, i, vertex, axis);
                if (side > 0) beyond = false;
                if (side == 0) on_line.push_back(vertex);
            }
            if (beyond) return in_one_line(t[i], t[(i + 1) % 3], on_line);
        }
        return std::nullopt;
    }

    /// What the edge p, q has in common with none, one or two vertices on its line that are a corner or an edge.
    TriangleMeeting in_one_line(std::uint32_t p, std::uint32_t q, const std::vector<std::uint32_t>& other) const {
        if (other.empty()) return {};
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (std::abs(at(q)[k] - at(p)[k]) > std::abs(at(q)[axis] - at(p)[axis])) axis = k;
        }
        const auto before = [&](std::uint32_t v, std::uint32_t w) { return at(v)[axis] < at(w)[axis]; };
        const auto [p_first, p_last] = std::minmax(p, q, before);
        const auto [r_first, r_last] = std::minmax(other.front(), other.back(), before);
        const std::uint32_t first = std::max(p_first, r_first, before), last = std::min(p_last, r_last, before);
        if (before(last, first)) return {};
        if (before(first, last)) return {Meeting::touch, {at(first), at(last)}};
        if (shared_ > 0) return {};
        return {Meeting::point, {at(first), at(first)}};
    }

    // ---- the extent of an overlap

    std::array<Vec3, 2> longest_extent() const {  // of the same triangle twice
        return farthest({at(a_[0]), at(a_[1]), at(a_[2])});
    }

    std::array<Vec3, 2> longest_extent(unsigned axis) const {
        std::vector<Vec3> corners;
        for (const auto& [t, other] : {std::pair{&a_, &b_}, std::pair{&b_, &a_}}) {
            for (const std::uint32_t vertex : *t) {
                if (inside(*other, 0, vertex, axis) >= 0 && inside(*other, 1, vertex, axis) >= 0 && inside(*other, 2, vertex, axis) >= 0) {
                    corners.push_back(at(vertex));
                }
            }
        }
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) {
                const std::uint32_t p = a_[i], q = a_[(i + 1) % 3], r = b_[j], s = b_[(j + 1) % 3];
                if (inside(a_, i, r, axis) * inside(a_, i, s, axis) >= 0 || inside(b_, j, p, axis) * inside(b_, j, q, axis) >= 0) continue;
                const double start = std::abs(area_2d(at(r), at(s), at(p), axis)), stop = std::abs(area_2d(at(r), at(s), at(q), axis));
                if (start + stop > 0) corners.push_back(between(at(p), at(q), start / (start + stop)));
            }
        }
        return farthest(corners);
    }

    static double area_2d(const Vec3& a, const Vec3& b, const Vec3& c, unsigned axis) { return cross(minus(b, a), minus(c, a))[axis]; }

    static std::array<Vec3, 2> farthest(const std::vector<Vec3>& points) {
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
    return TwoTriangles(vertices, a, b).answer();
}

}  // namespace geomend
