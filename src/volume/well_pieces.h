// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

#include "volume/cut_by_wells.h"
#include "volume/region_facets.h"

namespace geomend::volumes {

/// Parts the edges inside of regions evenly where they are longer than cells are to be; chains get their new vertices, which become
/// vertices of the model. \param size of edges at a place in a region; 0: any
/// \pre the facets are those of the model that was cut, with its inner edges
void part_edges(CutByWells& cut, std::span<RegionFacets> facets,
                const std::function<double(const RegionFacets& region, const Vec3& place)>& size);

}  // namespace geomend::volumes
