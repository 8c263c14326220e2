// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gridding/property_means.h"
#include "model/dataset.h"

namespace geomend::gridding {

/// What stands for missing in properties that were sampled.
inline constexpr double no_sample = -999;

/// A property that the grid has now.
struct SampledProperty {
    std::string name;
    Averaging how = Averaging::mean;
    std::uint64_t with = 0, without = 0;  ///< active cells with and without a value
};

struct SampledProperties {
    std::vector<Attribute> attributes;  ///< of cells, in the order of `report`
    std::vector<SampledProperty> report;
    std::vector<std::string> notes;  ///< what could not be taken, and why
};

/// Properties of objects brought to the active cells of a grid: numbers on the points or cells of meshes and lattices, the height of a
/// map, the regions of cells (as REGION), curves of wells. A cell is looked at in as many places as pieces of the object are in it along
/// each axis, at least 2 x 2 x 4 and at most 8 x 8 x 16, weighted by their volume; of wells it has the values whose places lie in it,
/// weighted by the length of the path between them. Where several objects have a property the first that has a value there counts.
/// \param rules which properties; empty: all
/// Failure (usage) for a rule without a property. Cost: linear in cells times places, in parallel.
Result<SampledProperties> sample_properties(const CornerPointGrid& grid, std::span<const Object> sources,
                                            std::span<const PropertyRule> rules);

}  // namespace geomend::gridding
