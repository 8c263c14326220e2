// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/contact.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/predicates.h"

// Two triangles in different planes meet on the line of these planes, where each has an interval. The order of the ends of
// the intervals is that of four-point orientations: P. Guigue and O. Devillers, "Fast and robust triangle-triangle overlap
// test using orientation predicates" (2003). Here the ends are found from the signs in cyclic order, so that vertices and
// edges in the other plane need no cases of their own; and the features come with the ends.

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

TriangleFeature edge_between(unsigned i, unsigned j) { return edge_feature((i + 1) % 3 == j ? i : j); }

TriangleFeature feature_at(const Sides& s, End end) {
    const unsigned corner = s[end.low] == 0 ? end.low : s[end.high] == 0 ? end.high : nothing;
    return corner != nothing ? corner_feature(corner) : edge_between(end.low, end.high);
}

/// What of the triangle lies between the two ends.
TriangleFeature between_ends(const Sides& s) {
    if (zeros(s) < 2) return TriangleFeature::face;
    const unsigned apex = s[0] != 0 ? 0 : s[1] != 0 ? 1 : 2;
    return edge_feature((apex + 1) % 3);
}

/// In one plane: on which side of the edges of a triangle the corners of the other lie, [edge][corner]; +1 is inside.
using EdgeSides = std::array<std::array<int, 3>, 3>;

/// Which of the edges of a triangle a point lies on, as bits.
unsigned edges_at(TriangleFeature f) {
    if (f == TriangleFeature::face) return 0;
    const unsigned i = index_of(f);
    return is_edge(f) ? 1u << i : (1u << i) | (1u << (i + 2) % 3);
}
unsigned edges_at(const ContactPoint& p) { return edges_at(p.on_a) | edges_at(p.on_b) << 3; }

/// Where a corner of the other triangle lies; nothing where it is outside.
std::optional<TriangleFeature> place_of(const EdgeSides& sides, unsigned corner) {
    unsigned on = 0;
    for (unsigned i = 0; i < 3; ++i) {
        if (sides[i][corner] < 0) return std::nullopt;
        if (sides[i][corner] == 0) on |= 1u << i;
    }
    for (unsigned f = 0; f < 6; ++f) {
        if (edges_at(static_cast<TriangleFeature>(f)) == on) return static_cast<TriangleFeature>(f);
    }
    return TriangleFeature::face;
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

    Contact answer() const {
        if (shared_ == 3) return the_same();
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

    static Contact segment(Meeting kind, const ContactPoint& first, const ContactPoint& last) { return {kind, 2, {first, last}}; }
    Contact point(const ContactPoint& p) const { return shared_ > 0 ? Contact{} : Contact{Meeting::point, 1, {p}}; }

    Contact the_same() const {
        Contact found{Meeting::overlap, 3, {}};
        for (unsigned i = 0; i < 3; ++i) {
            const auto j = static_cast<unsigned>(std::find(b_.begin(), b_.end(), a_[i]) - b_.begin());
            found.corners[i] = {corner_feature(i), corner_feature(j)};
        }
        return found;
    }

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

    Contact across(const Sides& a_sides, const Sides& b_sides) const {
        const End a_first = rising(a_sides), a_last = falling(a_sides);
        const End b_first = falling(b_sides), b_last = rising(b_sides);
        const int b_begins = along(a_last, b_first), b_ends = along(a_first, b_last);
        if (b_begins > 0 || b_ends < 0) return {};
        const auto both = [&](End of_a, End of_b) { return ContactPoint{feature_at(a_sides, of_a), feature_at(b_sides, of_b)}; };
        const auto only_a = [&](End of_a) { return ContactPoint{feature_at(a_sides, of_a), between_ends(b_sides)}; };
        const auto only_b = [&](End of_b) { return ContactPoint{between_ends(a_sides), feature_at(b_sides, of_b)}; };
        if (b_begins == 0) return point(both(a_last, b_first));
        if (b_ends == 0) return point(both(a_first, b_last));
        if (touches_at_a_corner(a_sides)) return point(only_a(a_first));
        if (touches_at_a_corner(b_sides)) return point(only_b(b_first));

        const int first = along(a_first, b_first), last = along(a_last, b_last);
        return segment(zeros(a_sides) == 2 || zeros(b_sides) == 2 ? Meeting::touch : Meeting::crossing,
                       first > 0   ? only_b(b_first)
                       : first < 0 ? only_a(a_first)
                                   : both(a_first, b_first),
                       last < 0   ? only_b(b_last)
                       : last > 0 ? only_a(a_last)
                                  : both(a_last, b_last));
    }

    // ---- one plane

    Contact in_one_plane() const {
        const unsigned axis = main_axis(at(a_[0]), at(a_[1]), at(a_[2]));
        const int a_turns = turn(a_, axis), b_turns = turn(b_, axis);
        const EdgeSides b_in_a = edge_sides(a_, a_turns, b_, axis);
        if (const auto edge = beside(b_in_a)) {
            if (shared_ == 2) return {};  // neighbours: they have nothing but their edge
            return in_one_line(a_, *edge, b_, b_in_a[*edge], false);
        }
        const EdgeSides a_in_b = edge_sides(b_, b_turns, a_, axis);
        if (const auto edge = beside(a_in_b)) return in_one_line(b_, *edge, a_, a_in_b[*edge], true);
        return overlap(b_in_a, a_in_b, a_turns, a_turns == b_turns, axis);
    }

    int turn(const Triangle& t, unsigned axis) const { return orientation_2d(at(t[0]), at(t[1]), at(t[2]), axis); }

    EdgeSides edge_sides(const Triangle& t, int turns, const Triangle& other, unsigned axis) const {
        EdgeSides found{};
        for (unsigned i = 0; i < 3; ++i) {
            const std::uint32_t p = t[i], q = t[(i + 1) % 3];
            for (unsigned j = 0; j < 3; ++j) {
                if (other[j] != p && other[j] != q) found[i][j] = turns * orientation_2d(at(p), at(q), at(other[j]), axis);
            }
        }
        return found;
    }

    /// The edge that has all of the other triangle beyond it or on its line, if one has.
    static std::optional<unsigned> beside(const EdgeSides& sides) {
        for (unsigned i = 0; i < 3; ++i) {
            if (std::all_of(sides[i].begin(), sides[i].end(), [](int side) { return side <= 0; })) return i;
        }
        return std::nullopt;
    }

    /// What an edge of t has in common with the corner or edge that the other has on its line.
    Contact in_one_line(const Triangle& t, unsigned edge, const Triangle& other, const std::array<int, 3>& sides, bool t_is_b) const {
        const std::array<unsigned, 2> t_ends{edge, (edge + 1) % 3};
        unsigned first = nothing, last = nothing;
        for (unsigned j = 0; j < 3; ++j) {
            if (sides[j] != 0) continue;
            if (first == nothing) first = j;
            last = j;
        }
        if (first == nothing) return {};
        const Vec3 &p = at(t[t_ends[0]]), &q = at(t[t_ends[1]]);
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (std::abs(q[k] - p[k]) > std::abs(q[axis] - p[axis])) axis = k;
        }
        const auto of_t = [&](unsigned i) { return at(t[i])[axis]; };
        const auto of_other = [&](unsigned j) { return at(other[j])[axis]; };
        const auto [t_first, t_last] = of_t(t_ends[0]) < of_t(t_ends[1]) ? t_ends : std::array<unsigned, 2>{t_ends[1], t_ends[0]};
        if (of_other(last) < of_other(first)) std::swap(first, last);

        const auto feature_of_t = [&](double x) {
            return x == of_t(t_first) ? corner_feature(t_first) : x == of_t(t_last) ? corner_feature(t_last) : edge_feature(edge);
        };
        const auto feature_of_other = [&](double x) {
            if (x == of_other(first)) return corner_feature(first);
            return x == of_other(last) ? corner_feature(last) : edge_between(first, last);
        };
        const auto common = [&](double x) {
            return t_is_b ? ContactPoint{feature_of_other(x), feature_of_t(x)} : ContactPoint{feature_of_t(x), feature_of_other(x)};
        };
        const double begin = std::max(of_t(t_first), of_other(first)), end = std::min(of_t(t_last), of_other(last));
        if (end < begin) return {};
        if (begin < end) return segment(Meeting::touch, common(begin), common(end));
        return point(common(begin));
    }

    // ---- an overlap

    /// The corners of the common polygon: corners of one in the other, and where edges pass each other.
    Contact overlap(const EdgeSides& b_in_a, const EdgeSides& a_in_b, int a_turns, bool turn_alike, unsigned axis) const {
        Contact found{Meeting::overlap, 0, {}};
        const auto add = [&](TriangleFeature on_a, TriangleFeature on_b) { found.corners[found.count++] = {on_a, on_b}; };
        for (unsigned i = 0; i < 3; ++i) {
            if (const auto on_b = place_of(a_in_b, i)) add(corner_feature(i), *on_b);
        }
        for (unsigned j = 0; j < 3; ++j) {
            const auto on_a = place_of(b_in_a, j);
            if (on_a && !is_corner(*on_a)) add(*on_a, corner_feature(j));
        }
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) {
                const unsigned i_end = (i + 1) % 3, j_end = (j + 1) % 3;
                if (b_in_a[i][j] * b_in_a[i][j_end] < 0 && a_in_b[j][i] * a_in_b[j][i_end] < 0) add(edge_feature(i), edge_feature(j));
            }
        }
        put_around(found);
        if (!turns_as_a(found, b_in_a, turn_alike, a_turns, axis)) std::reverse(found.corners.begin(), found.corners.begin() + found.count);
        return found;
    }

    /// Brings the corners into the order of the border: two follow each other where they lie on one edge of a or of b, for the
    /// line of an edge has two of them at most.
    static void put_around(Contact& c) {
        for (unsigned i = 0; i + 2 < c.count; ++i) {
            unsigned next = i + 1;
            while (next + 1u < c.count && (edges_at(c.corners[i]) & edges_at(c.corners[next])) == 0) ++next;
            std::swap(c.corners[i + 1], c.corners[next]);
        }
    }

    /// Whether the border runs the way a turns. Where an edge of b comes in through an edge of a, it goes on along b.
    bool turns_as_a(const Contact& c, const EdgeSides& b_in_a, bool turn_alike, int a_turns, unsigned axis) const {
        for (unsigned n = 0; n < c.count; ++n) {
            const ContactPoint& p = c.corners[n];
            if (!is_edge(p.on_a) || !is_edge(p.on_b)) continue;
            const bool comes_in = (b_in_a[index_of(p.on_a)][index_of(p.on_b)] < 0) == turn_alike;
            const ContactPoint& next = c.corners[(n + 1) % c.count];
            const unsigned along_it = comes_in ? edges_at(p.on_b) & edges_at(next.on_b) : edges_at(p.on_a) & edges_at(next.on_a);
            return along_it != 0;
        }
        const auto position = [&](const ContactPoint& p) -> const Vec3& {
            return is_corner(p.on_a) ? at(a_[index_of(p.on_a)]) : at(b_[index_of(p.on_b)]);
        };
        return orientation_2d(position(c.corners[0]), position(c.corners[1]), position(c.corners[2]), axis) == a_turns;
    }
};

}  // namespace

Contact contact(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b) { return TwoTriangles(vertices, a, b).answer(); }

}  // namespace geomend
