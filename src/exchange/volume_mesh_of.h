// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/brep.h"
#include "model/loss.h"
#include "model/volume_mesh.h"

namespace geomend::exchange {

/// A mesh with volume cells as the mesh that writers take: blocks by region and type; a face set for each surface of the model and
/// each side of it, and for what else lies between regions or around them; the named lines and points of the mesh as edge sets and node
/// sets; where vertices lie in the model; attributes of points and cells. Where the mesh has several points at one position, it is split
/// there, and stays so; points that it states to be one (Gocad's twins) are one vertex. What has no place is listed: polygons that are no
/// face of a cell, lines away from the cells, attributes of other things, sets of cells. \param model the boundary representation that was
/// made from the mesh; nullptr: the mesh has none Failure (cannot_hold) where there is no volume cell, or where the cells are no mesh, as
/// three of them at one face. Cost: n log n in cells and polygons.
Result<VolumeMesh> volume_mesh_of(const CellMesh& mesh, const BrepData* model, std::vector<Loss>& losses);

}  // namespace geomend::exchange
