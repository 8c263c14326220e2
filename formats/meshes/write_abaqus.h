// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/mesh_format.h"

namespace geomend::meshes {

/// The mesh part of an input deck of Abaqus or CalculiX: NODE; ELEMENT (C3D4, C3D6, C3D8, C3D10, C3D15, C3D20) with an ELSET for each
/// region; SURFACE with element and face (S1 ...) for each face set; NSET for node sets and for the nodes of edge sets. No materials,
/// sections or steps: a deck of the user's own takes it in with *INCLUDE. Both programs read 20 characters of a number: longer ones are
/// rounded to as many digits as fit, and counted (identity). \pre the mesh was prepared for "abaqus"
Result<std::vector<Loss>> write_abaqus(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::meshes
