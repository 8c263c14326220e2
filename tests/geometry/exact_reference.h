// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_pair.h"

namespace geomend::test {

__extension__ typedef __int128 Wide;

/// A fraction of small integers, always in lowest terms with a positive denominator.
struct Fraction {
    std::int64_t n = 0, d = 1;

    Fraction() = default;
    Fraction(std::int64_t integer) : n(integer) {}
    Fraction(Wide over, Wide under) {
        Wide a = over < 0 ? -over : over, b = under < 0 ? -under : under;
        while (b != 0) {
            const Wide rest = a % b;
            a = b;
            b = rest;
        }
        if (under < 0) a = -a;
        n = static_cast<std::int64_t>(over / a);
        d = static_cast<std::int64_t>(under / a);
    }
    friend Fraction operator+(Fraction x, Fraction y) { return {Wide{x.n} * y.d + Wide{y.n} * x.d, Wide{x.d} * y.d}; }
    friend Fraction operator-(Fraction x, Fraction y) { return {Wide{x.n} * y.d - Wide{y.n} * x.d, Wide{x.d} * y.d}; }
    friend Fraction operator*(Fraction x, Fraction y) { return {Wide{x.n} * y.n, Wide{x.d} * y.d}; }
    friend Fraction operator/(Fraction x, Fraction y) { return {Wide{x.n} * y.d, Wide{x.d} * y.n}; }
    friend bool operator==(const Fraction&, const Fraction&) = default;
    int sign() const { return n > 0 ? 1 : n < 0 ? -1 : 0; }
};

template <class Number>
int sign_of(const Number& x) {
    return x.sign();
}

template <class Number>
using PointOf = std::array<Number, 3>;
using Point = PointOf<Fraction>;

template <class Number>
PointOf<Number> operator-(const PointOf<Number>& a, const PointOf<Number>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
Number dot(const PointOf<Number>& a, const PointOf<Number>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
PointOf<Number> cross(const PointOf<Number>& a, const PointOf<Number>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
bool is_zero(const PointOf<Number>& a) {
    return a == PointOf<Number>{};
}

/// Slow and plain: the points that span what two triangles have in common, in fractions. They are corners of one in the
/// other, points where an edge passes through the other's plane inside it, and points where edges cross in one plane.
template <class Number>
class CommonPartOf {
public:
    using Point = PointOf<Number>;
    using Corners3 = std::array<Point, 3>;

    CommonPartOf(const Corners3& a, const Corners3& b) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (holds(b, a[i])) add(a[i]);
            if (holds(a, b[i])) add(b[i]);
            pierce(a[i], a[(i + 1) % 3], b);
            pierce(b[i], b[(i + 1) % 3], a);
            for (std::size_t j = 0; j < 3; ++j) cross_edges(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
        }
    }

    const std::vector<Point>& points() const { return points_; }
    /// -1 for nothing, 0 a point, 1 a segment, 2 an area
    int dimension() const {
        if (points_.size() < 2) return static_cast<int>(points_.size()) - 1;
        for (const Point& p : points_) {
            if (!is_zero(cross(points_[1] - points_[0], p - points_[0]))) return 2;
        }
        return 1;
    }

    static bool holds(const Corners3& t, const Point& p) {
        const Point n = cross(t[1] - t[0], t[2] - t[0]);
        if (sign_of(Number(dot(n, p - t[0]))) != 0) return false;
        for (std::size_t i = 0; i < 3; ++i) {
            if (sign_of(Number(dot(n, cross(t[(i + 1) % 3] - t[i], p - t[i])))) < 0) return false;
        }
        return true;
    }
    static bool holds(const Point& p, const Point& q, const Point& x) {
        return is_zero(cross(q - p, x - p)) && sign_of(Number(dot(x - p, q - p))) >= 0 && sign_of(Number(dot(x - q, p - q))) >= 0;
    }

private:
    std::vector<Point> points_;

    void add(const Point& p) {
        if (std::find(points_.begin(), points_.end(), p) == points_.end()) points_.push_back(p);
    }
    void pierce(const Point& p, const Point& q, const Corners3& t) {
        const Point n = cross(t[1] - t[0], t[2] - t[0]);
        const Number from = dot(n, p - t[0]), to = dot(n, q - t[0]);
        if (sign_of(from) * sign_of(to) >= 0) return;
        const Point x = at(p, q, Number(from / (from - to)));
        if (holds(t, x)) add(x);
    }
    void cross_edges(const Point& p, const Point& q, const Point& r, const Point& s) {
        const Point n = cross(q - p, s - r);
        if (is_zero(n) || sign_of(Number(dot(n, r - p))) != 0) return;
        const Point x = at(p, q, Number(dot(cross(r - p, s - r), n) / dot(n, n)));
        if (holds(p, q, x) && holds(r, s, x)) add(x);
    }
    static Point at(const Point& p, const Point& q, Number t) {
        const Point d = q - p;
        return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
    }
};
using CommonPart = CommonPartOf<Fraction>;
using Corners3 = CommonPart::Corners3;

inline Point exact(const Vec3& v) {
    return {static_cast<std::int64_t>(v[0]), static_cast<std::int64_t>(v[1]), static_cast<std::int64_t>(v[2])};
}

struct ExactMeeting {
    Meeting kind = Meeting::none;
    std::vector<Point> points;  ///< of the common part where it is more than what is shared
};

/// What meeting() should say for vertices at small integers.
inline ExactMeeting exact_meeting(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b) {
    const Corners3 p{exact(vertices[a[0]]), exact(vertices[a[1]]), exact(vertices[a[2]])};
    const Corners3 q{exact(vertices[b[0]]), exact(vertices[b[1]]), exact(vertices[b[2]])};
    long shared = 0;
    for (const std::uint32_t v : a) shared += std::count(b.begin(), b.end(), v);
    const CommonPart common(p, q);
    const int dimension = common.dimension();
    if (dimension == 2) return {Meeting::overlap, common.points()};
    if (dimension + 1 <= shared) return {};
    if (dimension == 0) return {Meeting::point, common.points()};
    for (const Corners3& t : {p, q}) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto on_edge = [&](const Point& x) { return CommonPart::holds(t[i], t[(i + 1) % 3], x); };
            if (std::all_of(common.points().begin(), common.points().end(), on_edge)) return {Meeting::touch, common.points()};
        }
    }
    return {Meeting::crossing, common.points()};
}

}  // namespace geomend::test
