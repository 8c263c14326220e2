// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>

#include "topology/lengths.h"

namespace geomend::validators {

/// The Dataset with its outlying points (M15) where they are likely to belong: what follows from a point that is known to be wrong is
/// then no finding of its own.
///
/// Where only the height is wrong, the point keeps its place on the map. Its height is then that of a stated key triangle of its
/// surface; or, on a free border, that of a point of other surfaces to which edges lead from all its neighbours on the border; or one
/// evened out between those of the points that elements join it with. Others go to the middle of what elements join them with. Points
/// at one position stay at one, but for those that only stand above each other (stacked_points.h); key triangles follow.
/// Nothing where no point lies far off. Cost: near-linear, where there are any.
std::optional<Dataset> with_outlying_points_pulled_in(const Dataset& dataset, const topology::LocalLengths& lengths);

}  // namespace geomend::validators
