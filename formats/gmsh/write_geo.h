// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::gmsh {

/// Writes a Gmsh script NAME.geo, and beside it NAME.msh (as write_msh) that it merges. Gmsh does not fill volumes that come
/// from a mesh: so those without elements, the regions of a boundary representation, are made by the script over the mesh's
/// surfaces, with their physical groups and the surfaces that lie inside of them. `gmsh -3 NAME.geo` then fills them.
/// Fails with `usage` on standard output, which has no place for a second file; else as write_msh.
Result<std::vector<Loss>> write_geo(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options);

}  // namespace geomend::gmsh
