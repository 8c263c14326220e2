// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/finding.h"
#include "model/corner_point.h"

namespace geomend::validators {

/// C32: active cells of local grids that lie outside of the host cells that they are stated to refine, or, where a file states a box
/// only, outside of its cells. An error where nothing of the cell lies in its host, a warning where only its centre lies outside.
/// Cylindrical grids are left out: their rings reach beyond the cells that they stand for. `grids` are those of one file. Cost: linear
/// in the cells of local grids; once per finding also in those of the host, for the cell that holds the first centre.
void check_local_hosts(std::span<const CornerPointGrid* const> grids, std::vector<Finding>& findings);

}  // namespace geomend::validators
