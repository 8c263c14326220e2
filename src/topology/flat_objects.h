// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/loss.h"
#include "model/objects.h"

namespace geomend::topology {

/// Whether a mesh holds nothing but points, lines and first-order faces, so that flat_objects() can take it apart.
bool has_no_volume_cells(const CellMesh& mesh);

/// The same geometry as surfaces, polylines and point sets, one for each entity (or for each dimension, where there are
/// none), with names, roles, attributes and sets: what formats hold whose cell meshes are volumes. Points keep their
/// order and ids. Corners and lines whose points belong to faces, too, are left out (identity: they follow from the
/// surfaces); points that no cell uses go with the object where there is just one, else into a point set.
/// \pre has_no_volume_cells(mesh). Cost: linear in points, cells and entities times used points.
std::vector<Object> flat_objects(const CellMesh& mesh, std::vector<Loss>& losses);

}  // namespace geomend::topology
