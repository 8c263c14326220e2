// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gridding/sampled_properties.h"
#include "pipeline/load.h"

namespace geomend {

/// Properties of other files for a grid.
struct PropertyRequest {
    std::vector<std::string> files;
    std::vector<std::string> properties;  ///< as of gridding::parse_properties(); empty: all
};

/// Reads the files, in order, and samples their properties (gridding::sample_properties); corner-point grids in map coordinates. The
/// attributes are the grid's then, beside what it has; those of a name that it has already are left out, with a note.
/// Failure as of load() and sample_properties().
Result<gridding::SampledProperties> add_properties(const PropertyRequest& request, const LoadOptions& load_options, CornerPointGrid& grid);

}  // namespace geomend
