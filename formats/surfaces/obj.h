// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::surfaces {

// Wavefront OBJ: one list of positions (v), polygons over them (f), lines (l) and points (p), under names of objects (o) and groups
// (g): a surface, polyline set or point set for each name. Texture coordinates, normals and materials are style; curves and free-form
// surfaces are listed as lost. Positions stay joined within a name as the file has them.

int sniff_obj(std::string_view head, std::string_view base_name);
/// Cost: linear.
Result<Dataset> read_obj(const Input& input, const ReadOptions& options);
Result<std::vector<Loss>> write_obj(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::surfaces
