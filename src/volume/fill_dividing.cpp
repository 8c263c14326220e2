// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "volume/cut_by_wells.h"
#include "volume/fill.h"
#include "volume/region_facets.h"
#include "volume/surface_points.h"

namespace geomend::volumes {

namespace {

/// Where tetrahedra of a region want vertices on its facets: the first try that ends, those first that keep facets whole where they can.
/// \param fewest tries: those that keep facets whole where they can, for a region that wells may be the trouble of
Result<SurfacePoints> wanted_points(const RegionFacets& facets, const FillOptions& options, bool fewest) {
    struct Try {
        const char* switches;
        std::uint32_t shuffle;
    };
    constexpr std::array tries = {Try{"QpYMT1e-14", 0}, Try{"QpYMT1e-14", 1}, Try{"QpYMT1e-14", 2},
                                  Try{"QpMT1e-14", 0},  Try{"QpMT1e-14", 1},  Try{"QpMT1e-14", 2}};
    for (const Try& one : std::span(tries).first(fewest ? 1 : tries.size())) {
        auto all = tetrahedra_of(facets, {}, one.switches, {one.shuffle}, options.limits, options.monitor);
        if (!all && all.why().kind == FailureKind::cancelled) return std::move(all).why();
        if (!all) continue;
        SurfacePoints points = points_on_facets(facets, *all);
        if (points.size() > 0) return points;
    }
    return SurfacePoints{};
}

/// The points that the regions want which are not filled.
Result<SurfacePoints> wanted_points(const BrepData& brep, const topology::FoundRegions& found, const Filled& filled,
                                    const FillOptions& options) {
    auto facets = facets_of_regions(brep, found);
    if (!facets) return std::move(facets).why();
    SurfacePoints all;
    for (const RegionFacets& region : *facets) {
        if (filled.regions[region.region].filled()) continue;
        auto points = wanted_points(region, options, filled.regions[region.region].well_edges > 0);
        if (!points) return points;
        all.on_edges.insert(all.on_edges.end(), points->on_edges.begin(), points->on_edges.end());
        all.inside.insert(all.inside.end(), points->inside.begin(), points->inside.end());
    }
    return all;
}

}  // namespace

Result<Filled> fill_dividing_surfaces(const BrepData& brep, const topology::FoundRegions& found, const FillOptions& options) {
    constexpr int most_rounds = 3;
    CutByWells cut{brep, {}, {}};
    if (!options.wells.empty()) {
        auto made = cut_by_wells(brep, found, options.wells, options.well_tolerance);
        if (!made) return std::move(made).why();
        cut = std::move(*made);
    }
    BrepData divided = cut.brep;
    auto filled = fill_regions(std::move(cut), found, options);
    std::uint64_t added = 0;
    for (int round = 0; filled && round < most_rounds; ++round) {
        if (std::ranges::all_of(filled->regions, &FilledRegion::filled)) break;
        const auto points = wanted_points(divided, found, *filled, options);
        if (!points) return points.why();
        if (points->size() == 0) break;
        divided = with_points(divided, *points);
        added += points->size();
        auto again = fill_regions(divided, found, options);
        if (!again) return again;
        for (std::size_t r = 0; r < again->regions.size(); ++r) {
            const auto& why = filled->regions[r].why_not;
            again->regions[r].why_not.insert(again->regions[r].why_not.begin(), why.begin(), why.end());
        }
        filled = std::move(again);
    }
    if (filled) filled->surface_vertices = added;
    return filled;
}

}  // namespace geomend::volumes
