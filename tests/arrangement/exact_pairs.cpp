// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/exact_pairs.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <set>

#include "geometry/exact_reference.h"

namespace geomend::test {

using Rational = boost::multiprecision::cpp_rational;

namespace {

using Exact = CommonPartOf<Rational>;

struct Corners {
    std::array<Vec3, 3> at;
    Triangle number;
    Vec3 low, high;
};

Corners corners_of(const TriangleSoup& soup, const Triangle& t) {
    Corners c{{soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]}, t, soup.vertices[t[0]], soup.vertices[t[0]]};
    for (const Vec3& p : c.at) {
        for (std::size_t k = 0; k < 3; ++k) {
            c.low[k] = std::min(c.low[k], p[k]);
            c.high[k] = std::max(c.high[k], p[k]);
        }
    }
    return c;
}

std::vector<Corners> distinct_triangles(const TriangleSoup& soup) {
    std::set<Triangle> seen;
    std::vector<Corners> kept;
    for (const Triangle& t : soup.triangles) {
        Triangle sorted = t;
        std::sort(sorted.begin(), sorted.end());
        if (seen.insert(sorted).second) kept.push_back(corners_of(soup, t));
    }
    std::sort(kept.begin(), kept.end(), [](const Corners& a, const Corners& b) { return a.low[0] < b.low[0]; });
    return kept;
}

bool boxes_meet(const Corners& a, const Corners& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
    }
    return true;
}

/// All corners of `others` lie surely on one side of the plane of t: by more than what rounding can do, estimated amply.
bool surely_on_one_side(const Corners& t, const Corners& others) {
    std::array<long double, 3> u{}, v{};
    long double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = static_cast<long double>(t.at[1][k]) - t.at[0][k];
        v[k] = static_cast<long double>(t.at[2][k]) - t.at[0][k];
        size = std::max<long double>({size, std::abs(u[k]), std::abs(v[k])});
    }
    const std::array<long double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    int above = 0, below = 0;
    for (const Vec3& p : others.at) {
        long double height = 0, reach = size;
        for (std::size_t k = 0; k < 3; ++k) {
            const long double w = static_cast<long double>(p[k]) - t.at[0][k];
            height += n[k] * w;
            reach = std::max(reach, std::abs(w));
        }
        const long double doubt = 1e-16L * size * size * reach;
        above += height > doubt ? 1 : 0;
        below += height < -doubt ? 1 : 0;
    }
    return above == 3 || below == 3;
}

Exact::Corners3 exactly(const Corners& c) {
    Exact::Corners3 e;
    for (std::size_t i = 0; i < 3; ++i) e[i] = {Rational(c.at[i][0]), Rational(c.at[i][1]), Rational(c.at[i][2])};
    return e;
}

bool has_no_area(const Exact::Corners3& t) { return is_zero(cross(t[1] - t[0], t[2] - t[0])); }

bool meet_in_more(const Corners& a, const Corners& b) {
    long shared = 0;
    for (const std::uint32_t v : a.number) shared += std::count(b.number.begin(), b.number.end(), v);
    if (surely_on_one_side(a, b) || surely_on_one_side(b, a)) return false;
    const auto p = exactly(a), q = exactly(b);
    if (has_no_area(p) || has_no_area(q)) return true;  // a triangle without area has no place in a cut
    const int dimension = Exact(p, q).dimension();
    return dimension == 2 || dimension + 1 > shared;
}

}  // namespace

std::size_t pairs_that_meet_exactly(const TriangleSoup& soup, std::size_t most) {
    const auto triangles = distinct_triangles(soup);
    std::size_t found = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = i + 1; j < triangles.size() && triangles[j].low[0] <= triangles[i].high[0]; ++j) {
            if (boxes_meet(triangles[i], triangles[j]) && meet_in_more(triangles[i], triangles[j]) && ++found == most) return found;
        }
    }
    return found;
}

}  // namespace geomend::test
