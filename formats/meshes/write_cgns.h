// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// CGNS as an HDF5 file: one base with one unstructured zone. Sections of elements for the cells of each region and type and for the faces
/// of each set, a sub-region of the zone for each region, boundary conditions for sets of faces and of nodes, families with their names and
/// roles, values at nodes and of cells. \pre prepared for the row "cgns"
/// Failure (cannot_hold, F021) where the program was built without the library or the mesh is too large for it, (unwritable, F020) where
/// the library cannot write. It works on a file among those for temporary files, which needs as much room as the result.
Result<std::vector<Loss>> write_cgns(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
