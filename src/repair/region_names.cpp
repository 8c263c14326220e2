// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/region_names.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/own_name.h"
#include "base/vectors.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

/// Per side of a patch (2 x patch, + 1 for its front) the region that was stated there, or no_index. A side inside of one
/// region says nothing.
std::vector<std::uint32_t> region_behind(const SurfaceModel& model) {
    std::vector<std::uint32_t> of(2 * model.model.patches.size(), no_index);
    for (std::uint32_t r = 0; r < model.regions.size(); ++r) {
        for (const auto& side : model.regions[r].sides) of[2 * side.surface.value + (side.front ? 1 : 0)] = r;
    }
    return of;
}

/// Whether a triangle is wound as the one that it is a piece of.
bool wound_as_source(const SurfaceModel& model, std::uint32_t t) {
    return dot(triangle_normal(model.model.soup, t), triangle_normal(model.source, model.origin.triangles[t])) >= 0;
}

struct Share {
    double volume, area;
    std::uint32_t now, before;  // regions
};

/// Of the regions as they were read, from the middle of what was: a region that was not closed is not far off then.
std::vector<double> old_volumes(const SurfaceModel& model, const std::vector<std::uint32_t>& behind) {
    std::vector<double> volumes(model.regions.size(), 0);
    const TriangleSoup& soup = model.source;
    Vec3 middle{};
    for (const Vec3& p : soup.vertices) middle = plus(middle, times(1.0 / static_cast<double>(soup.vertices.size()), p));
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto [a, b, c] = soup.triangles[t];
        const Vec3 u = minus(soup.vertices[a], middle), v = minus(soup.vertices[b], middle), w = minus(soup.vertices[c], middle);
        const double cone = dot(u, cross(v, w)) / 6;
        for (const std::uint32_t front : {0u, 1u}) {
            const std::uint32_t r = behind[2 * soup.patches[t] + front];
            if (r != no_index) volumes[r] += front != 0 ? -cone : cone;
        }
    }
    for (double& v : volumes) v = std::abs(v);
    return volumes;
}

/// How much of each old region each new one has, largest first: the share of its border, as that share of its volume.
std::vector<Share> shares_of(const SurfaceModel& model, const std::vector<std::vector<TriangleSide>>& sides) {
    const auto behind = region_behind(model);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> areas;
    for (std::uint32_t now = 0; now < sides.size(); ++now) {
        for (const TriangleSide& side : sides[now]) {
            if (model.origin.triangles[side.triangle] == no_index) continue;
            const std::uint32_t patch = model.source.patches[model.origin.triangles[side.triangle]];
            const bool front = side.front == wound_as_source(model, side.triangle);
            const std::uint32_t before = behind[2 * patch + (front ? 1 : 0)];
            if (before != no_index) areas[{now, before}] += triangle_area(model.model.soup, side.triangle);
        }
    }
    std::vector<double> whole(model.regions.size(), 0);
    for (const auto& [pair, area] : areas) whole[pair.second] += area;
    const auto volumes = old_volumes(model, behind);
    std::vector<Share> shares;
    for (const auto& [pair, area] : areas) {
        const double all = whole[pair.second];
        shares.push_back({all > 0 ? volumes[pair.second] * area / all : 0, area, pair.first, pair.second});
    }
    std::ranges::stable_sort(shares,
                             [](const Share& a, const Share& b) { return a.volume != b.volume ? a.volume > b.volume : a.area > b.area; });
    return shares;
}

/// Per new region the old one that it has most of, or no_index.
std::vector<std::uint32_t> before_of(const std::vector<Share>& shares, std::size_t regions) {
    std::vector<std::uint32_t> before(regions, no_index);
    for (const Share& share : shares) {
        if (before[share.now] == no_index) before[share.now] = share.before;
    }
    return before;
}

/// Per old region the new one that has its name: the one that has most of it among those that have most of it.
std::vector<std::uint32_t> heirs_of(const std::vector<Share>& shares, const std::vector<std::uint32_t>& before, std::size_t old_regions) {
    std::vector<std::uint32_t> heir(old_regions, no_index);
    for (const Share& share : shares) {
        if (heir[share.before] == no_index && before[share.now] == share.before) heir[share.before] = share.now;
    }
    return heir;
}

void carry_lists(const std::vector<topology::SurfaceComplex::RegionList>& lists, const std::vector<std::uint32_t>& before,
                 std::vector<BrepData::RegionList>& to) {
    to.clear();
    for (const auto& list : lists) {
        BrepData::RegionList made{list.name, {}, list.unresolved};
        for (std::uint32_t now = 0; now < before.size(); ++now) {
            if (std::ranges::find(list.regions, before[now]) != list.regions.end()) made.regions.emplace_back(now);
        }
        to.push_back(std::move(made));
    }
}

}  // namespace

std::vector<NameChange> carry_region_names(const SurfaceModel& model, const std::vector<std::vector<TriangleSide>>& sides, BrepData& data) {
    std::vector<NameChange> changes;
    if (model.regions.empty()) return changes;
    const auto shares = shares_of(model, sides);
    const auto before = before_of(shares, data.regions.size());
    const auto heir = heirs_of(shares, before, model.regions.size());
    std::set<std::string> used;
    for (std::uint32_t r = 0; r < heir.size(); ++r) {
        if (heir[r] == no_index) changes.push_back({NameChange::lost, model.regions[r].name, {}});
        else used.insert(data.regions[heir[r]].name = model.regions[r].name);
    }
    for (std::uint32_t now = 0; now < data.regions.size(); ++now) {
        auto& region = data.regions[now];
        if (before[now] != no_index && heir[before[now]] == now) continue;
        if (before[now] == no_index) {
            region.name = own_name(region.name, used);
            changes.push_back({NameChange::made, region.name, {}});
        } else {
            const std::string& from = model.regions[before[now]].name;
            region.name = own_name(from, used);
            changes.push_back({NameChange::parted, region.name, from});
        }
    }
    carry_lists(model.layers, before, data.layers);
    carry_lists(model.fault_blocks, before, data.fault_blocks);
    return changes;
}

}  // namespace geomend::repair
