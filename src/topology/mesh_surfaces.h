// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/objects.h"

namespace geomend::topology {

/// Two-dimensional cells of a mesh that are one surface.
struct MeshSurface {
    std::string name, role_text;
    FeatureRole role = FeatureRole::unknown;
    std::vector<std::uint32_t> cells;  ///< ascending
    std::uint32_t entity = no_index;   ///< number of its entity; no_index: told apart by an array, or not at all
    std::uint32_t part = no_index;     ///< its number; no_index: nothing says which surface its cells belong to
};

/// Whether a mesh has faces, but no volumes: neither cells of three dimensions nor entities.
bool is_surface_mesh(const CellMesh& mesh);

/// The surfaces of such a mesh: its entities that have cells, then the other cells by the values of a cell array that is called after
/// surfaces, as "surface", "patch_id" or "gmsh:physical"; one of all where there is none. Cost: n log n in cells.
std::vector<MeshSurface> surfaces_of_mesh(const CellMesh& mesh);

}  // namespace geomend::topology
