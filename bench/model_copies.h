// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "model/dataset.h"

namespace geomend::bench {

/// Copies of a model with its statements, side by side in one, four in a row. \pre one model over surfaces
Dataset copies_of(const Dataset& one, std::uint32_t copies, double spacing);

}  // namespace geomend::bench
