// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// The set of files of CSMP++: the named one (.asc) with the families of elements, NAME.dat with nodes, elements and their neighbours as
/// text, and NAME-regions.txt with the families that a model takes. Regions are families of cells by type, sets of faces such of triangles
/// and quadrangles, sets of edges such of bars; all elements are numbered on from 0. Its y is up: (x, y, z) is written as (x, z, -y).
/// Failure (usage) where the output is a stream. \pre the mesh was prepared for "csmp"
/// Source: the description of the format beside CSMP++'s own reader; A. Botella (2016), table 4.2.
Result<std::vector<Loss>> write_csmp(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
