// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/inner_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bounds.h"
#include "base/vectors.h"

namespace geomend {

namespace {

constexpr double most_points = 4'000;  // TetGen takes long for tetrahedra between more of them

}  // namespace

std::vector<volumes::SizedPoint> lattice_of_sizes(const volumes::RegionFacets& facets, double step,
                                                  const std::function<double(const Vec3&)>& size) {
    const Bounds box = bounds_around(facets.positions);
    const Vec3 across = minus(box.high, box.low);
    std::array<std::size_t, 3> count{};
    for (;; step *= 1.2) {
        double points = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const double steps = std::max(1.0, std::ceil(across[k] / step));
            points *= steps + 1;
            count[k] = static_cast<std::size_t>(std::min(steps, 1e6));
        }
        if (points <= most_points) break;
    }
    std::vector<volumes::SizedPoint> all;
    for (std::size_t i = 0; i <= count[0]; ++i) {
        for (std::size_t j = 0; j <= count[1]; ++j) {
            for (std::size_t k = 0; k <= count[2]; ++k) {
                const std::array<std::size_t, 3> at{i, j, k};
                Vec3 place = box.low;
                for (std::size_t m = 0; m < 3; ++m) place[m] += across[m] * static_cast<double>(at[m]) / static_cast<double>(count[m]);
                all.push_back({place, size(place)});
            }
        }
    }
    return all;
}

std::vector<volumes::SizedPoint> sizes_around(const volumes::RegionFacets& facets, std::span<const volumes::SizedPoint> all) {
    const Bounds box = bounds_around(facets.positions);
    const Vec3 across = minus(box.high, box.low), middle = times(0.5, plus(box.low, box.high));
    const double margin = 0.1 * std::sqrt(dot(across, across));
    std::vector<volumes::SizedPoint> some;
    for (const auto& s : all) {
        bool is_near = true;
        for (std::size_t k = 0; k < 3; ++k) is_near = is_near && s.place[k] >= box.low[k] - margin && s.place[k] <= box.high[k] + margin;
        if (is_near) some.push_back(s);
    }
    if (some.empty() && !all.empty()) {
        const auto far = [&](const volumes::SizedPoint& s) {
            const Vec3 d = minus(s.place, middle);
            return dot(d, d);
        };
        some.push_back(*std::ranges::min_element(all, {}, far));
    }
    return some;
}

}  // namespace geomend
