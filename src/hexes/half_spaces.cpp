// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/half_spaces.h"

#include <algorithm>
#include <cmath>

#include "model/objects.h"

namespace geomend::hexes {

namespace {

/// The point that is as deep in each of three half spaces as in a fourth, or far away where there is none.
Vec3 equally_deep(const HalfSpace& o, const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
    const Vec3 u = minus(a.normal, o.normal), v = minus(b.normal, o.normal), w = minus(c.normal, o.normal);
    const double det = dot(u, cross(v, w));
    if (std::abs(det) < 1e-14) return {1e300, 1e300, 1e300};
    const Vec3 sum = plus(plus(times(a.offset - o.offset, cross(v, w)), times(b.offset - o.offset, cross(w, u))),
                          times(c.offset - o.offset, cross(u, v)));
    return times(1 / det, sum);
}

/// The best of the points that four of five half spaces make equally deep: the fifth is one more than those of a best point before.
class FiveSpaces {
public:
    FiveSpaces(const std::vector<HalfSpace>& all, const std::array<std::uint32_t, 5>& numbers) {
        for (std::size_t out = 0; out < 5; ++out) {
            std::array<std::uint32_t, 4> four{};
            for (std::size_t k = 0, n = 0; k < 5; ++k) {
                if (k != out) four[n++] = numbers[k];
            }
            const Vec3 x = equally_deep(all[four[0]], all[four[1]], all[four[2]], all[four[3]]);
            if (!(std::abs(x[0]) < 1e290)) continue;
            const double depth = std::min(all[four[0]].depth(x), all[numbers[out]].depth(x));
            if (depth > best.depth) best = {x, depth, four};
        }
    }
    DeepestPlace best{{}, -HUGE_VAL, {}};
};

}  // namespace

void add_half_space(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<HalfSpace>& all) {
    const Vec3 n = cross(minus(b, a), minus(c, a));
    const double size = std::sqrt(dot(n, n));
    if (size > 0) all.push_back({times(1 / size, n), dot(n, a) / size});
}

std::optional<DeepestPlace> deepest_place(std::span<const HalfSpace> all, const Vec3& middle, double reach) {
    // Around the middle: the sides of a regular tetrahedron first.
    std::vector<HalfSpace> near;
    const double third = 1 / std::sqrt(3.0);
    for (const Vec3& normal : {Vec3{third, third, third}, {third, -third, -third}, {-third, third, -third}, {-third, -third, third}})
        near.push_back({normal, -reach});
    for (const HalfSpace& h : all) near.push_back({h.normal, h.offset - dot(h.normal, middle)});
    DeepestPlace best{{}, reach, {0, 1, 2, 3}};
    for (int round = 0; round < 100; ++round) {
        const auto shallowest = std::ranges::min_element(near, {}, [&](const HalfSpace& h) { return h.depth(best.place); });
        const auto number = static_cast<std::uint32_t>(shallowest - near.begin());
        if (shallowest->depth(best.place) >= best.depth - 1e-12 * reach) {
            for (std::uint32_t& t : best.tight) t = t < 4 ? no_index : t - 4;
            best.place = plus(best.place, middle);
            return best;
        }
        const FiveSpaces five(near, {best.tight[0], best.tight[1], best.tight[2], best.tight[3], number});
        if (!(five.best.depth > -HUGE_VAL)) return std::nullopt;
        best = five.best;
    }
    return std::nullopt;
}

}  // namespace geomend::hexes
