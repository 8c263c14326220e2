// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/open_diagonal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/vectors.h"
#include "hexes/half_spaces.h"
#include "hexes/jacobian.h"
#include "hexes/uphill.h"

namespace geomend::hexes {

namespace {

/// The least shape of the cells that a vertex at p makes, or something below `enough` where it is below that.
double quality_at(const Fan& fan, const Vec3& p, double enough) {
    const auto& q = fan.quad;
    double least = scaled_jacobian(CellType::pyramid, std::array{q[0], q[1], q[2], q[3], p});
    if (!fan.also.empty()) {
        const Vec3 across = minus(q[2], q[0]);
        const double size = std::sqrt(dot(across, across));
        for (const HalfSpace& h : fan.also) least = std::min(least, h.depth(p) / size);
    }
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

/// Where an apex may be so that no cell is inside out.
std::vector<HalfSpace> kernel_of(const Fan& fan) {
    std::vector<HalfSpace> all(fan.also.begin(), fan.also.end());
    const auto& q = fan.quad;
    for (std::size_t k = 0; k < 4; ++k) add_half_space(q[k], q[(k + 1) % 4], q[(k + 3) % 4], all);
    for (std::size_t i = 0; i + 1 < fan.chain.size(); ++i) {
        add_half_space(fan.chain[i], q[0], fan.chain[i + 1], all);
        add_half_space(q[2], fan.chain[i], fan.chain[i + 1], all);
    }
    return all;
}

/// The place deepest in the kernel.
void try_deepest(const Fan& fan, ApexPlace& best) {
    const Vec3 across = minus(fan.quad[2], fan.quad[0]);
    const auto deepest = deepest_place(kernel_of(fan), fan.quad[0], 10 * std::sqrt(dot(across, across)));
    if (deepest && deepest->depth > 0) try_place(fan, deepest->place, best);
}

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
    go_uphill(0.1 * size, best, [&](const Vec3& p, ApexPlace& now) { try_place(fan, p, now); });
    return best;
}

}  // namespace geomend::hexes
