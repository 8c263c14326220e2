// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// IRAP classic polygons (RMS, Petrel): x y z on each line, each polygon ended by 999.0 999.0 999.0 (the last one may
// go without). A polygon whose last point repeats its first is closed.
int sniff_irap_polygons(std::string_view head, std::string_view base_name);
Result<Dataset> read_irap_polygons(const Input& input, const ReadOptions& options);
Result<std::vector<Loss>> write_irap_polygons(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

// CPS-3 lines (fault traces, contours, polygons):
//   FFASCI 0 1 "LINES" 0 null
//   FFATTR 0 1
//   ->name
// then x y z on each line up to the next "->name".
int sniff_cps3_lines(std::string_view head, std::string_view base_name);
Result<Dataset> read_cps3_lines(const Input& input, const ReadOptions& options);
Result<std::vector<Loss>> write_cps3_lines(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::horizon
