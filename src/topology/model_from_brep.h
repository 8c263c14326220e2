// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "model/dataset.h"

namespace geomend::topology {

/// The same model as surfaces with a StatedModel over them (what Gocad Model3d holds): one Surface per
/// interface, one part per B-Rep surface, region sides, layers, fault blocks. Exact; what has no place
/// (cells of regions, cell attributes) is added to `losses`.
Dataset faced_model(const Brep& brep, std::vector<Loss>& losses);

/// The same model as one CellMesh with entities: vertices, lines, surface polygons and region cells, with
/// boundaries, names and roles (what MSH and Gocad solids hold). Surface attributes go along as far as shared
/// nodes allow; the rest is added to `losses`.
CellMesh tagged_mesh(const Brep& brep, std::vector<Loss>& losses);

}  // namespace geomend::topology
