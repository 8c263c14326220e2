// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "model/objects.h"

namespace geomend {

/// Area of all faces: polygons are split into the fan that the lowest corner makes; quadrangles by the diagonal
/// at their lowest corner index. Cost: linear.
double area(const Surface& surface);
double area(const CellMesh& mesh);  ///< of its two-dimensional cells

/// Sum of the absolute volumes of the three-dimensional cells. Hexahedra, wedges and pyramids are measured by
/// exact integration of their (tri)linear maps; polyhedra by the divergence theorem over fan-split faces.
double volume(const CellMesh& mesh);
/// Signed volume of one cell, positive in VTK's corner order. Corner order of second-order cells: their corners only.
double cell_volume(const CellMesh& mesh, std::size_t cell);
double volume(const StructuredGrid& grid);
double volume(const Raster& raster);

/// Smallest and largest coordinate over finite points; nothing when there are none.
std::optional<std::array<Vec3, 2>> bounds(const Object& object);

}  // namespace geomend
