// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/brep.h"
#include "model/dataset.h"

namespace geomend {

/// The boundary representations that checks find where a file states none.
struct FoundModels {
    std::vector<Brep> breps;
    std::uint64_t points_welded = 0;  ///< that gave way to another one that is near, but not equal
    double tolerance = 0;             ///< the largest at which they were
};

/// Those in the loose surfaces of a Dataset: pieces cut along the lines that surfaces share, wound one way, with the regions that they
/// close. Points are welded at `tolerance`; negative: at the one that validate takes by rule. Cost: near-linear in triangles.
Result<FoundModels> models_in_loose_surfaces(const Dataset& dataset, double tolerance);

/// Puts these in the place of the loose surfaces, as models that the Dataset states. Welding is listed as a loss of identity.
Result<void> state_found_models(Dataset& dataset, double tolerance);

}  // namespace geomend
