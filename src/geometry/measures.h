// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "model/objects.h"

namespace geomend {

// All measures work in coordinates relative to a point of the cell or face at hand, so that UTM coordinates do not
// cost digits, and are summed over fixed blocks in order: results do not depend on the number of threads.
// Indices must be in range (readers see to that) and coordinates finite.

/// Area of all faces: polygons are split into the fan that the lowest corner makes; quadrangles by the diagonal
/// at their lowest corner index. Triangles of a fan that are folded back count negative, so that the area of a
/// flat polygon is right even where it is not convex. Cost: linear.
double area(const Surface& surface);
double area(const CellMesh& mesh);  ///< of its two-dimensional cells

/// Sum of the absolute volumes of the three-dimensional cells. Hexahedra, wedges and pyramids are measured by
/// exact integration of their (tri)linear maps; polyhedra by the divergence theorem over fan-split faces. Prisms
/// with five or six sides: bilinear sides, fan-split ends. Cells of second order: as unsigned_volume() has them.
double volume(const CellMesh& mesh);
/// Signed volume of one cell, positive in VTK's corner order; 0 for cells that are not three-dimensional. Corner
/// order of second-order cells: their corners only. For a wedge that is the order of VTK's documentation and of
/// its face table, with the normal of (0,1,2) pointing out of the cell, although VTK's own cell sizes come out
/// negative then; for the other cells the base's normal points into the cell. A polyhedron whose faces are not all
/// wound the same way round is measured as wound like its first face; its sign is that of faces with normals
/// pointing out.
double cell_volume(const CellMesh& mesh, std::size_t cell);
/// The same with hexahedra cut into five tetrahedra and pyramids into two along the shorter diagonal of their base. It
/// is the figure that VTK and ParaView give for cells of first order; where faces are warped it differs from volume(), and neighbours
/// may overlap or leave gaps in it.
double volume_by_tetrahedra(const CellMesh& mesh);
/// Sum of the absolute trilinear volumes of the cells that are not blanked, with split nodes where they apply; 0
/// unless all three dims exceed 1.
double volume(const StructuredGrid& grid);
/// Of the box between the first and last samples; 0 unless all three dims exceed 1.
double volume(const Raster& raster);

/// Smallest and largest coordinate over finite points, elevation-up; nothing when there are none. A horizon grid
/// takes x and y from its whole lattice and z from those heights that are not missing.
std::optional<std::array<Vec3, 2>> bounds(const Object& object);

}  // namespace geomend
