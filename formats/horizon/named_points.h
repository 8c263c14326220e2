// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// Points as a table: a line with the names of the columns (X, Y and Z, or what programs call them), then a row per point. Columns stand
// between commas, semicolons, tabs or blanks. Further columns are attributes of their names; what is empty or NaN is missing. Tables that
// hold line numbers of a seismic survey (inline, crossline) on a lattice are maps (ijxyz_map.h).

int sniff_named_points(std::string_view head, std::string_view base_name);
/// Cost: linear. Options: z.
Result<Dataset> read_named_points(const Input& input, const ReadOptions& options);

/// Maps as rows of inline, crossline, x, y and z, without a line of names (IJXYZ): by extension or --from.
int sniff_ijxyz(std::string_view head, std::string_view base_name);
Result<Dataset> read_ijxyz(const Input& input, const ReadOptions& options);

}  // namespace geomend::horizon
