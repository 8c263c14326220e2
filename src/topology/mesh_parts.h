// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "topology/mesh_surfaces.h"
#include "topology/surface_complex.h"
#include "topology/twin_nodes.h"
#include "topology/welded_points.h"

namespace geomend::topology {

/// What the entities of one tagged mesh say, as tables over the mesh.
struct MeshParts {
    const CellMesh* mesh = nullptr;
    std::uint32_t object = no_index;                       ///< its number in the Dataset
    std::vector<std::vector<std::uint32_t>> entity_cells;  ///< per entity its cells, a face that is stated from both sides of a split once
    std::vector<std::vector<std::uint32_t>> numbers;       ///< per entity the numbers of its cells in it, where some are left out
    bool filled = false;                                   ///< some volume entity has cells
};
MeshParts parts_of_mesh(const CellMesh& mesh, std::uint32_t object);

/// Name of an entity: its own, else that of a group of it, else kind and tag.
std::string entity_name(const CellMesh& mesh, const CellMesh::Entity& entity, const char* kind);

/// The face of a two-dimensional entity, without names and role.
/// \pre entity is a number of an entity
SurfaceComplex::Face face_of_entity(const MeshParts& parts, std::uint32_t entity, const WeldedPoints& points);

/// The face of some cells of a mesh that is taken for loose surfaces, with name and role.
SurfaceComplex::Face face_of_cells(const CellMesh& mesh, std::uint32_t object, const MeshSurface& cells, const WeldedPoints& points);

/// Adds the lines and corners that the mesh states, with their names.
void add_lines_of_mesh(const MeshParts& parts, const WeldedPoints& points, SurfaceComplex& complex);

/// Adds the volume entities as volumes, bounded by those faces of the complex that are entities of the mesh.
/// \pre faces are there
void add_volumes_of_mesh(const MeshParts& parts, const WeldedPoints& points, SurfaceComplex& complex);

}  // namespace geomend::topology
