// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "base/output.h"
#include "formats/gocad/object_scanner.h"
#include "model/coordinate_system.h"

namespace geomend::gocad {

/// Reads GOCAD_ORIGINAL_COORDINATE_SYSTEM up to its terminator, or, where that is missing (F118), up to the first
/// record that cannot stand inside. `line` stands on the block's first line.
void read_coordinate_block(TextCursor& line, CoordinateSystem& crs, ObjectLog& log);

/// Whether a keyword cannot stand inside the block.
bool ends_coordinate_block(std::string_view keyword);

/// Writes the block; what is not stated gets Gocad's usual words, but for units.
void write_coordinate_block(OutputFile& out, const CoordinateSystem& crs);

/// The sign with which z goes out: -1 for depth.
inline double z_sign(const CoordinateSystem& crs) { return crs.z_positive == ZPositive::depth ? -1.0 : 1.0; }

}  // namespace geomend::gocad
