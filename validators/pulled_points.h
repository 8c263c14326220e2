// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>

#include "topology/lengths.h"

namespace geomend::validators {

/// The Dataset with its outlying points (M15) in the middle of those that elements join them with: what follows from a point that is
/// known to be wrong is then no finding of its own. Points at one position stay at one; those that only outlying points are joined
/// with come after these; key triangles follow. Nothing where no point lies far off. Cost: linear, where there are any.
std::optional<Dataset> with_outlying_points_pulled_in(const Dataset& dataset, const topology::LocalLengths& lengths);

}  // namespace geomend::validators
