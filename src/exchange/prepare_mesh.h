// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/loss.h"
#include "model/mesh_needs.h"
#include "model/volume_mesh.h"

namespace geomend::exchange {

/// A mesh that a writer only has to print, and what it cost.
struct PreparedMesh {
    VolumeMesh mesh;
    std::vector<Loss> losses;
};

/// Makes of a mesh what a target asks for. Cells that it does not know are left out, second order becomes first, sets and attributes
/// without a place are left out, sides of a surface become one set, and sets of one name one set. Names become words, unique and
/// short enough, where the target has such: of regions with the same name all but one get a number. Where the target has a face in one
/// set only, it belongs to the first set that has it. Each of these is listed.
/// The cells of a VolumeMesh are sorted by region and type, with their corners in VTK's order: a writer goes through the blocks in the
/// order in which its format has them.
/// Where the target wants the mesh split along its faults or all surfaces, or not at all, it is split or joined (split_mesh.h).
/// Failure (cannot_hold) where no cell would be left, and where cells of the second order would have to be split or joined. n log n.
Result<PreparedMesh> prepare(const VolumeMesh& mesh, const MeshNeeds& needs);

}  // namespace geomend::exchange
