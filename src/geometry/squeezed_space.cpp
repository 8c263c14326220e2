// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/squeezed_space.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace geomend {

namespace {

constexpr std::size_t bins = 256, long_gap = bins / 8, kept = bins / 64;
constexpr int most_rounds = 12;  // each shortens a gap to a 64th of the extent

}  // namespace

double SqueezedSpace::squeezed(const Round& gaps, double x) {
    double shift = 0, least = x;
    for (const Gap& gap : gaps) {
        if (x <= gap.from) return std::max(least, x - shift);
        if (x < gap.to) return gap.place;
        shift = gap.shift;
        least = gap.place;
    }
    return gaps.empty() ? x : std::max(least, x - shift);
}

/// \param starts per bin how many more triangles begin there than end before it
SqueezedSpace::Round SqueezedSpace::gaps_between(std::span<const int> starts, double low, double width) {
    Round gaps;
    std::int64_t there = 0;
    std::size_t empty = 0;
    double shift = 0;
    for (std::size_t bin = 0; bin < starts.size(); ++bin) {
        there += starts[bin];
        empty = there == 0 ? empty + 1 : 0;
        const bool ends = empty > 0 && (bin + 1 == starts.size() || there + starts[bin + 1] != 0);
        if (!ends || empty < long_gap) continue;
        // Half of what is kept lies on either side.
        const double from = low + width * (static_cast<double>(bin + 1 - empty) + 0.5 * kept);
        const double to = low + width * (static_cast<double>(bin + 1) - 0.5 * kept);
        gaps.push_back({from, to, from - shift, shift + (to - from)});
        shift = gaps.back().shift;
    }
    return gaps;
}

SqueezedSpace::SqueezedSpace(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3& low, const Vec3& high) {
    std::array<bool, 3> done{};
    for (int round = 0; round < most_rounds && done != std::array{true, true, true}; ++round) {
        std::array<std::array<int, bins + 1>, 3> starts{};
        Vec3 from{}, width{}, per_width{};
        for (std::size_t k = 0; k < 3; ++k) {
            from[k] = at(k, low[k]);
            width[k] = (at(k, high[k]) - from[k]) / bins;
            per_width[k] = 1 / width[k];
            done[k] = done[k] || !(width[k] > 0) || !std::isfinite(width[k]);
        }
        const auto bin_of = [&](std::size_t k, double x) {
            const double bin = (x - from[k]) * per_width[k];
            return bin > 0 ? static_cast<std::size_t>(std::min(bin, bins - 1.0)) : std::size_t{0};  // also what is no number
        };
        for (const Triangle& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (done[k]) continue;
                const double a = vertices[t[0]][k], b = vertices[t[1]][k], c = vertices[t[2]][k];
                ++starts[k][bin_of(k, at(k, std::min({a, b, c})))];
                --starts[k][bin_of(k, at(k, std::max({a, b, c}))) + 1];
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (done[k]) continue;
            auto gaps = gaps_between(std::span(starts[k]).first(bins), from[k], width[k]);
            if (gaps.empty()) done[k] = true;
            else rounds_[k].push_back(std::move(gaps));
        }
    }
}

}  // namespace geomend
