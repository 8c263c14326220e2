// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/polyline_join.h"

#include <algorithm>
#include <cstdint>

namespace geomend::validators {

namespace {

struct End {
    Vec3 at;
    std::uint32_t segment;
    bool second;
};

}  // namespace

std::vector<std::vector<Vec3>> join_segments(std::span<const std::array<Vec3, 2>> segments) {
    std::vector<std::array<Vec3, 2>> distinct;
    for (const auto& s : segments) {
        if (s[0] != s[1]) distinct.push_back(s[0] < s[1] ? s : std::array{s[1], s[0]});
    }
    // Two triangles of one surface at an edge give the same segment.
    std::vector<std::uint32_t> order(distinct.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return distinct[a] < distinct[b]; });
    std::vector<std::uint8_t> used(distinct.size(), 0);
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (distinct[order[i]] == distinct[order[i - 1]]) used[order[i]] = 1;
    }
    std::vector<End> ends;
    for (std::uint32_t i = 0; i < distinct.size(); ++i) {
        if (used[i] != 0) continue;
        ends.push_back({distinct[i][0], i, false});
        ends.push_back({distinct[i][1], i, true});
    }
    std::ranges::sort(ends, [](const End& a, const End& b) { return a.at != b.at ? a.at < b.at : a.segment < b.segment; });
    // Goes on from the end of a segment: to the only other segment there, if it is not used yet.
    const auto beyond = [&](const Vec3& at, std::uint32_t segment) -> const End* {
        const auto [first, last] = std::ranges::equal_range(ends, at, {}, &End::at);
        if (last - first != 2) return nullptr;
        const End& other = first->segment == segment ? *(first + 1) : *first;
        return used[other.segment] != 0 ? nullptr : &other;
    };
    std::vector<std::vector<Vec3>> lines;
    for (std::uint32_t i = 0; i < distinct.size(); ++i) {
        if (used[i] != 0) continue;
        used[i] = 1;
        std::vector<Vec3> line{distinct[i][0], distinct[i][1]};
        for (const bool forward : {true, false}) {
            std::uint32_t segment = i;
            while (const End* next = beyond(line.back(), segment)) {
                segment = next->segment;
                used[segment] = 1;
                line.push_back(distinct[segment][next->second ? 0 : 1]);
            }
            if (forward) std::ranges::reverse(line);
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace geomend::validators
