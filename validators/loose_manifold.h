// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "validators/model_scope.h"

namespace geomend::validators {

/// B03 of loose surfaces, which are taken apart at such places: edges that more than two triangles of one surface (of a part, where
/// it has parts) share, and points that its triangles go round more than once. Where all that meets there parts regions, nothing is
/// reported: so a whole model stands in one object. One finding for each surface. Cost: n log n in triangles.
/// \param pinched per surface of the model vertices where it touches itself, away from lines
void report_loose_manifold(const ModelScope& scope, const std::vector<std::vector<std::uint32_t>>& pinched, std::vector<Finding>& findings);

}  // namespace geomend::validators
