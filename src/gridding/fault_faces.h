// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "gridding/build_grid.h"
#include "gridding/node_depths.h"

namespace geomend::gridding {

/// The boxes of FAULTS for each chain, as high as the grid: runs of faces in line are one box. Each face is named once, from the cell of
/// lower i or j; with `both_sides` from the other cell, too (simulators then apply multipliers twice).
std::vector<FaultReport> add_faults(const Structure& structure, const Net& net, const Chains& chains, const SplitPillars& split,
                                    std::span<const NodeDepths> depths, bool both_sides, double cell, CornerPointGrid& grid);

}  // namespace geomend::gridding
