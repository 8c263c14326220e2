// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// ZMAP+ points and lines: '@name, DATA, width, 1' (or FAULT, POLY), a line per field (name, number, ZMAP code, ..., first and last column
// of its place in a row, ..., null value), '@', then a row per point. Fields of code 1, 2 and 3 are x, y and z, that of code 35 the number
// of the line that a point is of; where there is none, the points are points.

int sniff_zmap_lines(std::string_view head, std::string_view base_name);
/// Cost: linear. Options: z.
Result<Dataset> read_zmap_lines(const Input& input, const ReadOptions& options);

}  // namespace geomend::horizon
