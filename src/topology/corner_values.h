// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/brep.h"

// Node attributes of surfaces in a mesh whose points the surfaces share. Where two surfaces differ at a point, each cell
// has the values of all its corners, corner after corner: a cell attribute with CornerValues. (MSH holds this as
// $ElementNodeData, and its reader gives it in this form.)

namespace geomend::topology {

/// Components per corner of such a cell attribute; 0 for any other attribute.
std::uint32_t components_per_corner(const Attribute& attribute);

/// The node attributes of all surfaces as point or cell attributes of a mesh: on points where all surfaces have the
/// attribute and agree at every point (and no cells of regions could take them for theirs), else on corners.
/// \param first_cell per surface, the mesh cell of its first polygon; the others follow
/// \param tags per surface, the tag of its entity
/// \param cells number of cells of the whole mesh; its points are the model vertices
std::vector<Attribute> shared_node_attributes(const BrepData& brep, std::span<const std::size_t> first_cell,
                                              std::span<const std::int64_t> tags, std::size_t cells);

/// Turns corner values into node attributes of a surface, once its nodes and polygons are there. Where the corners of
/// the polygons around one node differ, the values stay polygon attributes.
/// \pre the attribute has corner_values
/// \param cells the mesh cell of each polygon
/// \param tag of the surface's entity
void add_corner_values(const CellMesh& mesh, const Attribute& attribute, std::span<const std::uint32_t> cells, std::int64_t tag,
                       BrepData::Surface& surface);

/// True when the values are missing in all cells.
bool missing_in(const Attribute& attribute, std::span<const std::uint32_t> cells);

}  // namespace geomend::topology
