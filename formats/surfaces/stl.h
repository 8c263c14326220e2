// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::surfaces {

// STL: triangles, each with its three positions and a normal. A text file is a series of solids with names, each a surface; a binary
// one holds single precision and no name. Positions that are the very same become one point, else nothing would hang together. Normals
// follow from the order of corners: where a file says otherwise, the order is kept and F113 says so.

int sniff_stl(std::string_view head, std::string_view base_name);
/// Cost: linear.
Result<Dataset> read_stl(const Input& input, const ReadOptions& options);
/// Option encoding=text|binary; text keeps all digits.
Result<std::vector<Loss>> write_stl(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::surfaces
