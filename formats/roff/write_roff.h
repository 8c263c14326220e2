// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::roff {

/// Writes a corner-point grid and its cell attributes; one without pillars and depths gives a file of parameters.
/// Coordinates are stored as float32 around the offsets that the grid came with, or around whole numbers near its
/// middle where they are large; what rounding changes is a loss. Nodes have as few depths as are exact.
Result<std::vector<Loss>> write_roff_binary(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
Result<std::vector<Loss>> write_roff_text(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::roff
