// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::surfaces {

// PLY: a header that announces elements and their properties, then the values, as text or as bytes of either order. Elements 'vertex'
// and 'face' become a surface (without faces a point set), 'edge' polylines; numbers at them become attributes. Other elements and lists
// are listed as lost. After G. Turk's description of 1994.

int sniff_ply(std::string_view head, std::string_view base_name);
/// Cost: linear.
Result<Dataset> read_ply(const Input& input, const ReadOptions& options);
/// All surfaces as one. Option encoding=text|binary (little-endian); both keep doubles.
Result<std::vector<Loss>> write_ply(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::surfaces
