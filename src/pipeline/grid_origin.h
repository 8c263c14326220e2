// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/result.h"
#include "formats/format.h"
#include "model/dataset.h"

namespace geomend {

/// Option origin=local: corner-point grids get coordinates from a round origin near them, with MAPAXES, so that files of
/// single precision keep them (grid::local_frame). Local refinements go along with the grid that they refine. What was
/// done is a finding F154. Failure (usage) for other values and for formats that hold no map axes.
Result<void> move_grid_origins(Dataset& dataset, const Format& target, const FormatOptions& options);

}  // namespace geomend
