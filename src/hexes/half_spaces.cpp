// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/half_spaces.h"

#include <algorithm>
#include <cmath>

namespace geomend::hexes {

namespace {

double least_depth(std::span<const HalfSpace> all, const Vec3& x, double enough) {
    double least = 1e300;
    for (const HalfSpace& h : all) {
        least = std::min(least, h.depth(x));
        if (least <= enough) return least;
    }
    return least;
}

/// The point that is as deep in each of three half spaces as in a fourth, or far away where there is none.
Vec3 equally_deep(const HalfSpace& o, const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
    const Vec3 u = minus(a.normal, o.normal), v = minus(b.normal, o.normal), w = minus(c.normal, o.normal);
    const double det = dot(u, cross(v, w));
    if (std::abs(det) < 1e-14) return {1e300, 1e300, 1e300};
    const Vec3 sum = plus(plus(times(a.offset - o.offset, cross(v, w)), times(b.offset - o.offset, cross(w, u))),
                          times(c.offset - o.offset, cross(u, v)));
    return times(1 / det, sum);
}

}  // namespace

void add_half_space(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<HalfSpace>& all) {
    const Vec3 n = cross(minus(b, a), minus(c, a));
    const double size = std::sqrt(dot(n, n));
    if (size > 0) all.push_back({times(1 / size, n), dot(n, a) / size});
}

std::optional<Vec3> deepest_place(std::span<const HalfSpace> all) {
    constexpr std::size_t most = 28;
    if (all.size() > most) return std::nullopt;
    double depth = 0;
    std::optional<Vec3> place;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            for (std::size_t k = j + 1; k < all.size(); ++k) {
                for (std::size_t m = k + 1; m < all.size(); ++m) {
                    const Vec3 x = equally_deep(all[i], all[j], all[k], all[m]);
                    if (!(all[i].depth(x) > depth) || !(std::abs(x[0]) < 1e290)) continue;
                    const double least = least_depth(all, x, depth * (1 + 1e-9));
                    if (least > depth * (1 + 1e-9)) {
                        depth = least;
                        place = x;
                    }
                }
            }
        }
    }
    return place;
}

}  // namespace geomend::hexes
