// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "model/mesh_needs.h"

namespace geomend::exchange {

/// Names as a target can write them: no longer than it allows; as words, if it wants such; names that differ stay different, by a
/// number at their end (as words, also from names in other letters' case); those that are the same stay the same. A name that fits
/// is kept, whatever comes before it; one that is shortened keeps the side of a surface at its end. The map has all names that were given.
/// Cost: n log n.
std::map<std::string, std::string> target_names(const std::vector<std::string>& names, Naming naming, std::size_t longest);

}  // namespace geomend::exchange
