// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "formats/format.h"

// Legacy VTK files (.vtk), read and written without the VTK library, whose own reader cuts damaged files short
// without a word and whose text writer keeps 11 digits.

namespace geomend::vtk {

/// Reads a legacy file of version 1.0 to 5.1, text or binary, of any kind of dataset but graphs and tables. One
/// dataset becomes one object (none for a file that holds only FIELD arrays without a dataset: those become an
/// annotation of the Dataset).
Result<Dataset> read_legacy(const Input& input, const ReadOptions& options);

/// Writes the one object of a Dataset. Options: encoding=text|binary, version=5.1|4.2.
/// Failure (cannot_hold) where there is no object or more than one.
Result<std::vector<Loss>> write_legacy(const Dataset& dataset, OutputSet& output, const WriteOptions& options);

/// 100 where the first line is that of a legacy file.
int sniff_legacy(std::string_view head, std::string_view base_name);

}  // namespace geomend::vtk
