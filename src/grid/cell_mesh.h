// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grid/faces.h"
#include "model/objects.h"

namespace geomend::grid {

/// Cells of a corner-point grid as cells of a mesh, elevation-up.
struct Cells {
    CellMesh mesh;
    std::vector<std::uint32_t> source;     ///< per mesh cell the cell of the grid
    std::vector<std::uint32_t> collapsed;  ///< active cells without any thickness: they make no cell
    std::uint64_t unmatched_columns = 0;   ///< as in GridFaces
};

/// Each present cell by itself: a hexahedron; where pillars are pinched a wedge, a pyramid, a tetrahedron or, where none
/// of these fits, a polyhedron without faces of no area. Sides at faults do not match. Volumes are positive where the
/// cell is not inside out: the grid's handedness is taken account of.
Cells plain_cells(const CornerPointGrid& grid);

/// Polyhedra that fit face to face (conforming_faces).
Cells conforming_cells(const CornerPointGrid& grid);
/// The same with less memory: of the grid pillars, depths and values of attributes of cells are gone afterwards.
Cells take_conforming_cells(CornerPointGrid& grid);

/// Attributes by which each cell is found again: I J K, GlobalIndex and ActiveIndex, all from 1, then all attributes of
/// the grid's cells.
std::vector<Attribute> cell_attributes(const CornerPointGrid& grid, std::span<const std::uint32_t> source);
/// The same; the grid loses the values.
std::vector<Attribute> take_cell_attributes(CornerPointGrid& grid, std::span<const std::uint32_t> source);

/// True where most of the cells are right-handed in (x, y, depth).
bool right_handed(const CornerPointGrid& grid);

}  // namespace geomend::grid
