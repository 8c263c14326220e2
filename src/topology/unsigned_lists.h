// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "topology/regions.h"

namespace geomend::topology {

/// Lists of surfaces that bound regions, without a sign at any of them: some meshers write none. Finds by walking along the surfaces
/// which region each list bounds, and on which side of each surface it lies: a region may have several shells, the outer one and those
/// around other bodies in it. A list that bounds none of the regions that there are stays as it is. Cost: that of find_regions().
void find_sides_of_lists(const Assembly& a, std::span<StatedRegion> lists);

}  // namespace geomend::topology
