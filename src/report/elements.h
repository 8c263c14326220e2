// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "base/finding.h"

namespace geomend {

/// How many of a finding's `elements` make one element: 3 for kinds that end with "-ijk", 2 for "-ij", else 1.
std::size_t numbers_of_element(const Finding& finding);

/// The kind without that ending: "cell", "pillar", "column", "triangle".
std::string element_kind(const Finding& finding);

}  // namespace geomend
