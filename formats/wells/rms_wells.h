// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::wells {

// RMS wells: a line with the version, one with the type of the well, one with its name, x, y and the height of its kelly bushing
// (may be missing), one with the number of logs, a line per log (name, type, then its scale or the codes of a DISC log with their
// names), then a row per point: x, y, depth and a value per log. -999 stands for missing. Several wells may follow each other.

int sniff_rms_wells(std::string_view head, std::string_view base_name);
/// A log called MD or MDEPTH gives the measured depths; where there is none, logs stand along the length of the path (F163). Linear.
Result<Dataset> read_rms_wells(const Input& input, const ReadOptions& options);
/// Writes all wells. Logs go in where they stand on the points of the path.
Result<std::vector<Loss>> write_rms_wells(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::wells
