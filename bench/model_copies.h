// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "model/dataset.h"

namespace geomend::bench {

/// Where copies lie: in rows of four; all in one row; in a square; four to a row, but the last one 10^5 spacings away.
enum class Layout : std::uint8_t { rows_of_four, row, square, one_far };

/// Copies of a model with its statements, side by side in one. \pre one model over surfaces
Dataset copies_of(const Dataset& one, std::uint32_t copies, double spacing, Layout layout = Layout::rows_of_four);

}  // namespace geomend::bench
