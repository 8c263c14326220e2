// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/brep.h"
#include "topology/line_graph.h"
#include "topology/twin_nodes.h"

namespace geomend::topology {

/// The cells of each entity of a mesh, in cell order; those of another dimension than the entity are none of its.
std::vector<std::vector<std::uint32_t>> cells_by_entity(const CellMesh& mesh);

/// The corners of a cell, without the further nodes of second-order types.
std::span<const std::uint32_t> corner_nodes(const CellMesh& mesh, std::size_t cell);

/// One B-Rep surface of some two-dimensional cells. Its nodes are the points that they use, ascending, then its twins;
/// point attributes go along only when asked for, values at the corners of cells become node attributes, and cell
/// attributes polygon attributes unless all is missing.
/// \param vertex_of per mesh point its model vertex
/// \param tag of the entity that the cells belong to
BrepData::Surface surface_of_cells(const CellMesh& mesh, const std::vector<std::uint32_t>& cells,
                                   const std::vector<std::uint32_t>& vertex_of, std::int64_t tag, const Twins* twins,
                                   bool with_point_attributes);

/// Corners and lines that the mesh's entities of dimension 0 and 1 state; a line's number is that of its entity.
StatedLines stated_lines(const CellMesh& mesh, const std::vector<std::vector<std::uint32_t>>& cells,
                         const std::vector<std::uint32_t>& vertex_of);

}  // namespace geomend::topology
