// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/lip_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace geomend::editing {

std::vector<std::pair<std::uint32_t, std::uint32_t>> lip_pairs(std::span<const double> angles, double most) {
    const double limit = 2 * most / static_cast<double>(angles.size()) * (1 + 1e-12);
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> candidates;
    for (std::uint32_t a = 0; a < angles.size(); ++a) {
        for (std::uint32_t b = a + 1; b < angles.size(); ++b) {
            const double apart = std::fmod(std::abs(angles[a] - angles[b]), 2 * std::numbers::pi);
            const double bend = std::abs(apart - std::numbers::pi);
            if (bend <= limit) candidates.emplace_back(bend, a, b);
        }
    }
    std::ranges::sort(candidates);
    std::vector<std::uint8_t> taken(angles.size(), 0);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [bend, a, b] : candidates) {
        if (taken[a] != 0 || taken[b] != 0) continue;
        taken[a] = taken[b] = 1;
        pairs.emplace_back(a, b);
    }
    std::ranges::sort(pairs);
    return pairs;
}

}  // namespace geomend::editing
