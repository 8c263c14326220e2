// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// ZMAP+ grids (Landmark), as ASCII. '!' begins a comment line. Header, comma-separated:
//   @title, GRID, nodes per line
//   field width, null number, null text, decimals implied where no point is written, first column of the data
//   rows, columns, xmin, xmax, ymin, ymax
//   three numbers that nobody uses
//   @
// Heights in fields of fixed width, blanks between them or not, column by column from the west, each from north to
// south. The limits are those of the nodes. Other kinds of ZMAP+ file (points, polygons) are F013.

int sniff_zmap(std::string_view head, std::string_view base_name);

/// Cost: linear. Lines that do not follow the field width are split at blanks. When no height of the whole file has
/// a point or an exponent, the implied decimals apply (told as F113).
Result<Dataset> read_zmap(const Input& input, const ReadOptions& options);
/// Fields are as wide as the longest number needs, so that all digits go out.
Result<std::vector<Loss>> write_zmap(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::horizon
