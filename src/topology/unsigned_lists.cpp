// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/unsigned_lists.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "topology/frontiers.h"

namespace geomend::topology {

namespace {

bool is_before(const BrepData::Side& a, const BrepData::Side& b) {
    return a.surface != b.surface ? a.surface < b.surface : a.front < b.front;
}

/// A region that was found: its sides in order, and the surfaces that it has on one side only.
struct Found {
    std::vector<BrepData::Side> sides;
    std::vector<SurfaceId> single;
};

Found found_of(std::vector<BrepData::Side> sides) {
    std::ranges::sort(sides, is_before);
    Found found{std::move(sides), {}};
    for (std::size_t i = 0; i < found.sides.size();) {
        std::size_t j = i + 1;
        while (j < found.sides.size() && found.sides[j].surface == found.sides[i].surface) ++j;
        if (j == i + 1) found.single.push_back(found.sides[i].surface);
        i = j;
    }
    return found;
}

/// The sides of a region on the surfaces of a list; empty where the region does not have all of these, or is bounded by others.
std::vector<BrepData::Side> sides_in(const Found& found, const std::vector<SurfaceId>& list) {
    std::vector<BrepData::Side> sides;
    if (!std::ranges::includes(list, found.single)) return {};
    std::size_t at = 0;
    for (const SurfaceId surface : list) {
        while (at < found.sides.size() && found.sides[at].surface < surface) ++at;
        if (at == found.sides.size() || found.sides[at].surface != surface) return {};
        for (; at < found.sides.size() && found.sides[at].surface == surface; ++at) sides.push_back(found.sides[at]);
    }
    return sides;
}

}  // namespace

void find_sides_of_lists(const Assembly& a, std::span<StatedRegion> lists) {
    std::multimap<SurfaceId, Found> by_first;  // surface of those that bound it
    for (auto& sides : find_regions(a.brep, a.graph, a.cones, a.tolerances).regions) {
        Found found = found_of(std::move(sides));
        if (found.single.empty()) continue;
        const SurfaceId first = found.single.front();
        by_first.emplace(first, std::move(found));
    }
    for (StatedRegion& list : lists) {
        std::vector<SurfaceId> surfaces;
        for (const auto& side : list.sides) surfaces.push_back(side.surface);
        std::ranges::sort(surfaces);
        surfaces.erase(std::ranges::unique(surfaces).begin(), surfaces.end());
        std::vector<BrepData::Side> sides;
        for (std::size_t i = 0; i < surfaces.size() && sides.empty(); ++i) {
            const auto [first, last] = by_first.equal_range(surfaces[i]);
            for (auto at = first; at != last && sides.empty(); ++at) sides = sides_in(at->second, surfaces);
        }
        if (!sides.empty()) list.sides = std::move(sides);
    }
}

}  // namespace geomend::topology
