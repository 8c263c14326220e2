// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/objects.h"

namespace geomend::topology {

/// Gives a mesh whose cells have volume entities the surfaces that its file leaves out: facets between cells of different entities,
/// and around all cells, that are no face of the mesh yet. For each pair of entities (or an entity and the outside) they become one
/// entity of dimension 2, named after both ("lower_upper", "lower_outside"); their normals point out of the first. Equal positions
/// count as one node. Attributes of cells are missing there.
/// \return the number of faces added. Cost: n log n in facets.
std::size_t add_region_surfaces(CellMesh& mesh);

}  // namespace geomend::topology
