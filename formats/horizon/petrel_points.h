// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// Petrel points with attributes:
//   # Petrel Points with attributes
//   # Unit in X and Y direction: m
//   # Unit in depth: m
//   VERSION 1
//   BEGIN HEADER
//   X
//   Y
//   Z
//   FLOAT,name
//   END HEADER
// then one row per point. Types: FLOAT, DOUBLE, INT, STRING (in quotes), BOOL, DATE; -999 stands for missing.

int sniff_petrel_points(std::string_view head, std::string_view base_name);
/// Cost: linear. Options: z.
Result<Dataset> read_petrel_points(const Input& input, const ReadOptions& options);
Result<std::vector<Loss>> write_petrel_points(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::horizon
