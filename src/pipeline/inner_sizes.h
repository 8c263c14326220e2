// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "volume/region_facets.h"
#include "volume/tetrahedra.h"

namespace geomend {

/// Sizes at the points of a lattice over a region: a function of places. \param step the lattice's, which is larger where there would be
/// more than some 4,000 points. Cost: that of so many calls.
std::vector<volumes::SizedPoint> lattice_of_sizes(const volumes::RegionFacets& facets, double step,
                                                  const std::function<double(const Vec3&)>& size);

/// The points with sizes that lie in a region's box or near it; where there are none, the one that is nearest to its middle.
std::vector<volumes::SizedPoint> sizes_around(const volumes::RegionFacets& facets, std::span<const volumes::SizedPoint> all);

}  // namespace geomend
