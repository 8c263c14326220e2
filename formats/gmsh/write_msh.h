// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::gmsh {

/// Writes MSH 4.1 (default) or 2.2 (version=2.2), text or binary (binary=yes). A single CellMesh goes out as it is,
/// several objects become one mesh with an entity and a named physical group each. Second-order cells go out with
/// their corners (a substance loss), or as they are with order=2. Names, roles, units and no-data values stand in a
/// section $Geomend, which clients pass over.
/// Fails with `usage` for options that are not known, with `cannot_hold` where there is not one point.
Result<std::vector<Loss>> write_msh(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options);

}  // namespace geomend::gmsh
