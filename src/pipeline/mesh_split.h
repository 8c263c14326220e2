// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "base/result.h"
#include "model/dataset.h"

namespace geomend {

/// What was doubled along surfaces.
struct SplitReport {
    std::uint64_t surfaces = 0, vertices = 0, pairs = 0;
};

/// Doubles the points of the mesh of cells in a Dataset along surfaces, and puts it in its place (cell_mesh_of()). What a StatedModel says
/// beside the mesh does not fit afterwards: it is listed as lost. \param which "faults", "all", or names of surfaces or interfaces between
/// commas; "none" does nothing Failure (usage, F018) where a name is none of the mesh's, with the nearest one; else as volume_mesh_in() and
/// split_along().
Result<SplitReport> split_mesh(Dataset& dataset, const std::string& which, std::vector<Loss>& losses);

}  // namespace geomend
