// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::gmsh {

/// Reads MSH 1, 2.0 to 2.2, 4.0 and 4.1, text and binary of either byte order, into one CellMesh with entities and
/// physical groups. Elements are of the types of CellType; higher orders are read by their corners (a substance
/// loss). Data become attributes. Cost: one pass over the text on all threads, two over its line ends.
/// Source: Gmsh reference manual, "MSH file format" and its legacy formats.
Result<Dataset> read_msh(const Input& input, const ReadOptions& options);

}  // namespace geomend::gmsh
