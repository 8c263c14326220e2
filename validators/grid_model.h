// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "base/result.h"
#include "grid/boundary_model.h"
#include "validators/grid_scope.h"

namespace geomend::validators {

/// Judges the boundary representation of a grid (grid::boundary_model): whether its regions close and are what surfaces
/// bound (B05 B06 B12 B13), and whether it runs into itself: between columns that share no pillar (C27), and where bent
/// faces of neighbours cross as triangles only (C28). Findings name cells. Where columns overlap or are folded (C03, C04,
/// C11) their sides stay open: then only what lies apart from each other is judged, and F162 says so; also where the grid has
/// not what is requested (a warning).
/// Failure: of boundary_model(), and of topology::models_to_judge(). Cost: near-linear in cells.
Result<void> check_grid_model(const GridScope& scope, const grid::ModelRequest& request, const CheckOptions& options,
                              std::vector<Finding>& findings);

}  // namespace geomend::validators
