// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "gridding/build_grid.h"
#include "gridding/node_depths.h"

namespace geomend::gridding {

/// The first layer of each zone, and their number.
struct LayerPlan {
    std::vector<std::uint32_t> first;
};

/// As many layers as rules ask for; thicknesses are those at nodes. Failure (usage) where these are too many for a rule, or all of them
/// for the numbers of cells. \param names of the zones \pre depths are in order at each node
Result<LayerPlan> plan_layers(std::span<const ZoneLayers> zones, std::span<const std::string> names, std::span<const NodeDepths> depths);

/// Corner depths and activity of all cells. \pre dims are set. How many cells were joined with a neighbour comes back.
/// Cost: linear in cells, in parallel.
std::uint64_t fill_cells(const Net& net, const SplitPillars& split, std::span<const NodeDepths> depths, const GridOptions& options,
                         const LayerPlan& plan, CornerPointGrid& grid);

/// Volumes and numbers of cells of each zone.
void measure_zones(const CornerPointGrid& grid, std::span<ZoneReport> zones);

}  // namespace geomend::gridding
