// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/objects.h"

namespace geomend::topology {

/// Two-dimensional cells of a mesh, or polygons of a surface, that are one surface.
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

/// The surfaces that such an array tells apart in one object, as in poly data; empty where there is no such array, where all its values
/// are the same, and where the file itself says what the object is, by its parts, its role or its feature. Cost: n log n in polygons.
std::vector<MeshSurface> surfaces_by_array(const Surface& surface);

}  // namespace geomend::topology
