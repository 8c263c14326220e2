// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>

#include "formats/gocad/solid_plan.h"
#include "model/objects.h"

namespace geomend::gocad {

/// The mesh as Gocad keeps solids: each volume has nodes of its own, and a node that an earlier volume has becomes a twin
/// of it (ATOM, SHAREDVRTX). So do the two sides of a surface inside a volume: tetrahedra around a node share it where
/// they hang together across facets that lie on no surface. Nodes stand in the order of the volumes, those of no volume at the end; cells
/// keep their order, cells that are no tetrahedra use the first of the twins. Values and sets of nodes go to the twins as well, control
/// flags do not. Nothing where the mesh has twins already, or no node belongs to two volumes. Cost: proportional to nodes, cells and
/// values; a second mesh in memory.
std::optional<CellMesh> split_at_volumes(const CellMesh& mesh, const SolidPlan& plan);

}  // namespace geomend::gocad
