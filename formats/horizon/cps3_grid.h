// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// CPS-3 grids (Schlumberger), as ASCII:
//   FSASCI 0 1 "COMPUTED" 0 null
//   FSATTR 0 0
//   FSLIMI xmin xmax ymin ymax zmin zmax
//   FSNROW rows columns
//   FSXINC xstep ystep
//   ->name
// then heights separated by blanks, column by column from the west, each from north to south. '!' begins a comment.

int sniff_cps3_grid(std::string_view head, std::string_view base_name);

/// Cost: linear. FSXINC may be missing; where it contradicts the limits, the limits are taken (told as F113).
Result<Dataset> read_cps3_grid(const Input& input, const ReadOptions& options);
Result<std::vector<Loss>> write_cps3_grid(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::horizon
