// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// IRAP classic points (RMS, Petrel): x y z on each line. RMS puts attributes behind them, declared in front by lines
// "Float name", "Discrete name" or "String name"; UNDEF and -999 stand for missing. Further columns without such
// lines become attributes "column 4", ... Rows of 999.0 999.0 999.0 begin a new part.

inline constexpr std::string_view points_extensions[] = {".irapp", ".xyz", ".poi", ".rmsattr"};
bool has_points_extension(std::string_view base_name);

int sniff_irap_points(std::string_view head, std::string_view base_name);
/// Cost: linear. Options: z.
Result<Dataset> read_irap_points(const Input& input, const ReadOptions& options);
/// Writes one point set; attributes only with --option attributes=rms, since other programs do not know that header.
Result<std::vector<Loss>> write_irap_points(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::horizon
