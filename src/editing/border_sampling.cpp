// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/border_sampling.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"

namespace geomend::editing {

std::uint32_t common_edges(std::uint32_t fewest_nodes, bool closed) {
    const std::uint32_t edges = closed ? fewest_nodes : fewest_nodes - std::min(fewest_nodes, 1u);
    return std::max(edges, 2u);
}

bool same_order(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    if (a.size() != b.size()) return false;
    std::vector<std::uint32_t> turned = b;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (a == turned) return true;
        std::ranges::rotate(turned, turned.begin() + 1);
    }
    return a == b;
}

std::vector<std::uint32_t> prevailing_order(std::span<const std::vector<std::uint32_t>> groups) {
    std::vector<std::uint32_t> best;
    std::size_t most = 0;
    for (const auto& group : groups) {
        if (group.empty()) continue;
        const auto count =
            static_cast<std::size_t>(std::ranges::count_if(groups, [&](const auto& other) { return same_order(group, other); }));
        if (count <= most) continue;
        most = count;
        best = group;
    }
    return best;
}

Vec3 relaxed_place(std::span<const std::array<Vec3, 3>> triangles) {
    const Vec3 base = triangles.front()[0];  // what is small is not lost far from the origin
    Vec3 sum{};
    double areas = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 n = cross(minus(b, a), minus(c, a));
        const double area = std::sqrt(dot(n, n));
        const Vec3 middle = times(1. / 3, plus(plus(minus(a, base), minus(b, base)), minus(c, base)));
        sum = plus(sum, times(area, middle));
        areas += area;
    }
    return plus(base, times(1 / areas, sum));
}

}  // namespace geomend::editing
