// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/mesh_needs.h"

namespace geomend::exchange {

/// Names as a target can write them, in the order of those given: no longer than it allows; as words, if it wants such; all different
/// (as words, also where only the case of letters differs), by a number at their end. A name that fits is kept, whatever comes before
/// it, but for the same name; one that is shortened keeps the side of a surface at its end.
/// Cost: n log n.
std::vector<std::string> target_names(const std::vector<std::string>& names, Naming naming, std::size_t longest);

}  // namespace geomend::exchange
