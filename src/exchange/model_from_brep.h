// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/dataset.h"

namespace geomend::exchange {

/// The same model as surfaces with a StatedModel over them (what Gocad Model3d holds): one Surface per
/// interface, one part per B-Rep surface, region sides, layers, fault blocks. Exact; what has no place
/// (cells of regions, cell attributes) is added to `losses`.
Dataset faced_model(const Brep& brep, std::vector<Loss>& losses);

/// The same model as one CellMesh with entities: vertices, lines, surface polygons and region cells, with
/// boundaries, names and roles (what MSH and Gocad solids hold). Surface attributes go along as far as shared
/// nodes allow; the rest is added to `losses`.
CellMesh tagged_mesh(const Brep& brep, std::vector<Loss>& losses);

/// The same as tagged_mesh(), for formats that carry text along (dataset_text): the mesh, and beside it a StatedModel
/// whose faces are the mesh's two-dimensional entities, with layers, fault blocks, features and interfaces. Where
/// surfaces have different values at a shared point, the values go to the corners of cells (see corner_values.h), and
/// the mesh states its twins (twin_nodes.h), so that build_breps() gives the same model.
Dataset tagged_model(const Brep& brep, std::vector<Loss>& losses);

}  // namespace geomend::exchange
