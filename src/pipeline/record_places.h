// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "model/dataset.h"
#include "report/report.h"

namespace geomend {

/// Gives findings about the contents of a file the line of the record that they speak of, where it is known or can be looked up:
/// the first triangle, point or border that they list, else the list of the region, layer or fault block that they name. Of Gocad
/// files only; others leave the line as it is, and so does standard input. Lines get the path as their file.
/// Cost: a pass over the text where there is something to look up.
void give_lines(const std::string& path, const Dataset& dataset, const NamesInFile& names, std::span<Finding> findings);

}  // namespace geomend
