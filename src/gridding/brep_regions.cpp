// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/brep_regions.h"

#include "base/parallel.h"
#include "grid/cell_geometry.h"
#include "topology/upward_ray.h"

namespace geomend::gridding {

namespace {

/// The region that a place is in: the one whose sides are passed an odd number of times on the way up; no_index: none.
std::uint32_t region_at(const topology::UpwardRay& ray, const BrepData& brep, const Vec3& place) {
    const auto hits = ray.above(place, [](std::uint32_t) { return true; });
    if (!hits) return no_index;
    std::vector<std::uint32_t> passed(brep.regions.size(), 0);
    for (const auto& hit : *hits) {
        for (const RegionId region : brep.surfaces[hit.surface].regions) {
            if (region.valid()) ++passed[region.value];
        }
    }
    for (std::uint32_t r = 0; r < passed.size(); ++r) {
        if (passed[r] % 2 == 1) return r;
    }
    return no_index;
}

}  // namespace

Attribute brep_regions(const CornerPointGrid& grid, const BrepData& brep) {
    const topology::UpwardRay ray(brep);
    std::vector<std::int32_t> values(grid.cell_count(), 0);
    parallel_blocks(values.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) {
            if (!grid.is_active(c)) continue;
            const auto [i, j, k] = grid.ijk(c);
            Vec3 middle = grid::centre(cell_corners(grid, i, j, k));
            middle[2] = -middle[2];  // regions are elevation-up
            const std::uint32_t region = region_at(ray, brep, middle);
            if (region != no_index) values[c] = static_cast<std::int32_t>(region) + 1;
        }
    });
    Attribute attribute;
    attribute.name = "REGION";
    attribute.location = AttributeLocation::cell;
    attribute.values = std::move(values);
    for (std::size_t r = 0; r < brep.regions.size(); ++r) attribute.code_names.emplace_back(static_cast<int>(r) + 1, brep.regions[r].name);
    return attribute;
}

}  // namespace geomend::gridding
