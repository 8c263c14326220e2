// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "volume/cut_by_wells.h"
#include "volume/region_facets.h"

namespace geomend::volumes {

/// Where two wells come nearest to each other inside of a region, without meeting.
struct NearWells {
    std::string first, second;  ///< names; the same where a well comes near itself
    double distance = 0;
    Vec3 place{};
};

/// In words: both wells, the distance and the place.
std::string near_wells_text(const NearWells& near);

/// Parts the edges inside of regions where they are longer than cells are to be, or than the distance to another one that passes there;
/// chains get their new vertices, which become vertices of the model. \param size of edges at a place in a region; 0: any
/// \return for each of the facets where wells come nearest to each other, as far as cells between them have to be smaller by it
/// Failure (limit, F026), with both names and the place, where wells run beside each other too near for a mesh.
/// \pre the facets are those of the model that was cut, with its inner edges. Cost: as the pairs of edges whose boxes are that near.
Result<std::vector<std::optional<NearWells>>> part_edges(CutByWells& cut, std::span<RegionFacets> facets,
                                                         const std::function<double(const RegionFacets& region, const Vec3& place)>& size);

}  // namespace geomend::volumes
