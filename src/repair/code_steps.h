// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "base/result.h"

namespace geomend::repair {

/// The steps that mend findings of a code, by their own statements (`mends`), in the order in which they are taken: those of
/// surfaces, then those of corner-point grids.
std::vector<std::string_view> steps_for(std::string_view code);

/// Why no step mends findings of a code; empty where one does, and for codes that are not in the catalogue.
std::string_view why_unmended(std::string_view code);

/// Failure (usage) where neither surfaces nor grids have a step of a name; with the nearest one, and all of them.
Result<void> known_step(std::string_view name);

}  // namespace geomend::repair
