// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/open_diagonal.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hexes/jacobian.h"

namespace geomend::hexes {

namespace {

/// The least shape of the cells that a vertex at p makes, or something below `enough` where it is below that.
double quality_at(const Fan& fan, const Vec3& p, double enough) {
    const auto& q = fan.quad;
    double least = scaled_jacobian(CellType::pyramid, std::array{q[0], q[1], q[2], q[3], p});
    for (std::size_t i = 0; least > enough && i + 1 < fan.chain.size(); ++i) {
        const Vec3 &x = fan.chain[i], &y = fan.chain[i + 1];
        least = std::min(least, scaled_jacobian(CellType::tetrahedron, std::array{x, q[0], y, p}));
        if (least > enough) least = std::min(least, scaled_jacobian(CellType::tetrahedron, std::array{q[2], x, y, p}));
    }
    return least;
}

void try_place(const Fan& fan, const Vec3& p, ApexPlace& best) {
    const double quality = quality_at(fan, p, best.quality);
    if (quality > best.quality) best = {p, quality};
}

/// A half space: the points x with dot(normal, x) >= offset, the normal of length 1.
struct HalfSpace {
    Vec3 normal;
    double offset;
    double depth(const Vec3& x) const { return dot(normal, x) - offset; }
};

void add_half_space(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<HalfSpace>& all) {
    const Vec3 n = cross(minus(b, a), minus(c, a));
    const double size = std::sqrt(dot(n, n));
    if (size > 0) all.push_back({times(1 / size, n), dot(n, a) / size});
}

/// Where an apex may be so that no cell is inside out.
std::vector<HalfSpace> kernel_of(const Fan& fan) {
    std::vector<HalfSpace> all;
    const auto& q = fan.quad;
    for (std::size_t k = 0; k < 4; ++k) add_half_space(q[k], q[(k + 1) % 4], q[(k + 3) % 4], all);
    for (std::size_t i = 0; i + 1 < fan.chain.size(); ++i) {
        add_half_space(fan.chain[i], q[0], fan.chain[i + 1], all);
        add_half_space(q[2], fan.chain[i], fan.chain[i + 1], all);
    }
    return all;
}

double least_depth(const std::vector<HalfSpace>& all, const Vec3& x, double enough) {
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

/// The place deepest in all half spaces: four of them are equally near there. Cost: the fourth power of their number.
void try_deepest(const Fan& fan, ApexPlace& best) {
    const std::vector<HalfSpace> all = kernel_of(fan);
    if (all.size() > 28) return;
    double depth = 0;
    Vec3 place{};
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
    if (depth > 0) try_place(fan, place, best);
}

}  // namespace

namespace {

/// Some places above the middle of the quadrangle.
void try_above(const Fan& fan, double enough, ApexPlace& best) {
    const auto& q = fan.quad;
    const Vec3 normal = cross(minus(q[2], q[0]), minus(q[3], q[1]));
    const double area = std::sqrt(dot(normal, normal)), size = std::sqrt(area);
    const Vec3 middle = times(0.25, plus(plus(q[0], q[1]), plus(q[2], q[3])));
    for (const double height : {0.03, 0.06, 0.12, 0.25, 0.5}) {
        if (best.quality > enough) return;
        if (area > 0) try_place(fan, plus(middle, times(height * size / area, normal)), best);
        for (std::size_t i = 1; i + 1 < fan.chain.size(); ++i)
            try_place(fan, plus(middle, times(height, minus(fan.chain[i], middle))), best);
    }
}

}  // namespace

bool has_place_for_apex(const Fan& fan) {
    ApexPlace best{{}, -1};
    try_above(fan, 1e-5, best);
    if (best.quality <= 1e-5) try_deepest(fan, best);
    return best.quality > 1e-5;
}

ApexPlace place_for_apex(const Fan& fan) {
    const auto& q = fan.quad;
    const Vec3 across = minus(q[2], q[0]);
    const double size = std::sqrt(dot(across, across));
    ApexPlace best{q[0], -1};
    try_above(fan, 2, best);
    if (best.quality <= 0) try_deepest(fan, best);
    // Uphill steps along the axes, halved where none leads on.
    double step = 0.1 * size;
    for (int round = 0; round < 24; ++round) {
        const ApexPlace before = best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                Vec3 p = before.position;
                p[axis] += sign * step;
                try_place(fan, p, best);
            }
        }
        if (best.quality <= before.quality) step *= 0.5;
    }
    return best;
}

}  // namespace geomend::hexes
