// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>

#include "model/brep.h"

namespace geomend::exchange {

/// A surface at cells is what lies between two regions, and may be in several parts; in a model of surfaces each part is a surface of its
/// own. Gives the model with such surfaces in parts, in their order and behind their first part, named with a number; the lines of a
/// surface go to all of its parts. Nothing where no surface at cells is in parts. Cost: linear; a copy of the model where there are.
std::optional<BrepData> with_connected_surfaces(const BrepData& brep);

}  // namespace geomend::exchange
