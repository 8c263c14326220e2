// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/loss.h"
#include "model/volume_mesh.h"
#include "topology/weld.h"

namespace geomend::exchange {

/// The volume cells of a mesh as a VolumeMesh holds them, with the way back.
struct SolidCells {
    VolumeMeshData data;                      ///< name, system, vertices and their origins, regions, blocks and cells; nothing else
    std::vector<std::uint32_t> source_cells;  ///< per cell that of the mesh
    std::vector<std::uint32_t> vertex_of;     ///< per point of the mesh its vertex; no_index: no cell uses it
    topology::Welder places{0};               ///< the positions of vertices, each once
    std::vector<std::uint32_t> place_of;      ///< per vertex the number of its position
};

/// Sorts the volume cells of a mesh by region (an entity of dimension 3; cells of none have one of their own) and type, in file order
/// within. Points that the mesh states to be one (alias) are one vertex; further points at one position stay vertices of their own,
/// since that is how a mesh is split. Cells are wound as VolumeMesh has them, whatever the file's order; flat cells stay as they are.
/// Cells that use a point twice and polyhedra that do not close are left out and listed. Points that nothing uses are no vertices.
/// \pre indices are in range, as readers see to. Cost: n log n in the cells.
SolidCells solid_cells(const CellMesh& mesh, std::vector<Loss>& losses);

}  // namespace geomend::exchange
