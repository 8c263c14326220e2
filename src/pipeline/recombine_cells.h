// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "hexes/recombine.h"
#include "model/dataset.h"
#include "pipeline/json_parts.h"

namespace geomend {

/// Makes hexahedra of the tetrahedra of the mesh in a Dataset, and puts the new mesh in its place. Points that were doubled along
/// surfaces are one again. What a file says beside its cells does not fit afterwards: it is listed as lost.
/// \return the new mesh. Failure as volume_mesh_in() and hexes::recombine().
Result<VolumeMesh> recombine_cells(Dataset& dataset, const hexes::RecombineOptions& options, hexes::RecombineReport& report,
                                   std::vector<Loss>& losses);

/// What was found and done, for JSON.
Json recombined_json(const hexes::RecombineReport& report);

/// By type: its share of the volume and of the number of cells.
Json shares_json(const hexes::RecombineReport& report);

/// The same in some lines of text.
std::string recombined_text(const hexes::RecombineReport& report);

}  // namespace geomend
