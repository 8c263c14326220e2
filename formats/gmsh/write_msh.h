// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "formats/format.h"

namespace geomend::gmsh {

/// Writes MSH 4.1 (default) or 2.2 (version=2.2), text or binary (binary=yes). A single CellMesh goes out as it is,
/// several objects become one mesh with an entity and a named physical group each. Second-order cells go out with
/// their corners (a substance loss), or as they are with order=2. Names, roles, units and no-data values stand in a
/// section $Geomend, which clients pass over.
/// Fails with `usage` for options that are not known, with `cannot_hold` where there is not one point.
Result<std::vector<Loss>> write_msh(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options);

/// Volumes to be filled: they have no elements yet. Groups are all that the mesh has.
struct HollowVolumes {
    std::vector<CellMesh::Entity> volumes;
    std::vector<CellMesh::Group> groups;
};

/// As write_msh, into one file. \param named the file in messages
/// \param hollow if not null, volumes without elements are put there instead of into the file
Result<std::vector<Loss>> write_mesh_file(const Dataset& dataset, OutputFile& out, const std::filesystem::path& named,
                                          const WriteOptions& options, HollowVolumes* hollow);

}  // namespace geomend::gmsh
