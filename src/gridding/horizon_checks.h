// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "base/result.h"
#include "gridding/node_depths.h"

namespace geomend::gridding {

/// Failure (cannot_hold, F027) where a pillar meets a horizon more than once on the same side of all faults: horizons, places, extents.
/// With `allowed` none.
Result<void> refuse_repeated(const Structure& structure, const Net& net, const SplitPillars& split, std::span<const NodeDepths> depths,
                             bool allowed);

}  // namespace geomend::gridding
