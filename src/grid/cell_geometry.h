// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "model/corner_point.h"

// Measures of the cells of corner-point grids. All of them are in (x, y, depth), so that a positive volume means that
// (I, J, K) is right-handed there. Corners are in the order of corner_index(). Rules: trilinear cells after Ponting
// (1989).

namespace geomend::grid {

using Corners = std::array<Vec3, 8>;

/// Signed volume of the trilinear cell: exact but for rounding, whatever the sign of its Jacobian in places.
double cell_volume(const Corners& corners);

/// Signed volume of cell (i,j,k); of cylindrical grids that of the sector of a ring.
double cell_volume(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k);

/// Signed volumes of all cells, inactive ones included. Cost: linear, in parallel.
std::vector<double> cell_volumes(const CornerPointGrid& grid);

/// Sum of the absolute volumes of active cells. The result does not depend on the number of threads.
double volume(const CornerPointGrid& grid);

/// Mean of the eight corners; its z is the depth of the cell as simulators take it.
Vec3 centre(const Corners& corners);

/// Mean thickness: mean depth of the four bottom corners less that of the top ones.
double thickness(const Corners& corners);

/// Centre of volume of the trilinear cell, by 3x3x3 Gauss points; the mean of the corners where the volume is 0.
Vec3 centroid(const Corners& corners);

/// Determinant of the map's derivatives at a point of the unit cube (u along I, v along J, w along K).
double jacobian(const Corners& corners, double u, double v, double w);

/// The determinant at the eight corners.
std::array<double, 8> corner_jacobians(const Corners& corners);

}  // namespace geomend::grid
