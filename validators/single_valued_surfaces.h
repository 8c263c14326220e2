// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "validators/model_scope.h"

namespace geomend::validators {

/// For each triangle of the scope's tree, in its order, the surface that it is of where is_single_valued() proves that this surface
/// meets itself nowhere; NodeGroups::mixed where that is unknown. Cost: linear.
std::vector<std::uint32_t> single_valued_surfaces(const ModelScope& scope);

}  // namespace geomend::validators
