// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "base/vectors.h"
#include "model/objects.h"

namespace geomend::hexes {

/// Determinant of three edges from a point over the product of their lengths; 0 where one has none.
inline double scaled_determinant(const Vec3& at, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(a, at), v = minus(b, at), w = minus(c, at);
    const double lengths = std::sqrt(dot(u, u) * dot(v, v) * dot(w, w));
    return lengths > 0 ? dot(u, cross(v, w)) / lengths : 0;
}

/// The least scaled determinant over the corners of a cell, 1 for the best cell of its type: a cube, a prism over an equilateral triangle
/// with upright edges, a regular tetrahedron. A pyramid with its apex as high above a square as the square is wide has 0.82.
/// \pre corners in VTK's order, of a tetrahedron, pyramid, wedge or hexahedron
double scaled_jacobian(CellType type, std::span<const Vec3> corners);

/// Whether the map of a cell is nowhere folded: its Jacobian determinant is positive all over the cell, decided by its Bezier
/// coefficients (A. Johnen, J.-C. Weill, J.-F. Remacle, "Robust and efficient validation of the linear hexahedral element", 2017), which
/// are halved some times where they do not decide. Cells that are still undecided are refused. Cost: 0.3 microseconds for a hexahedron.
bool is_valid(CellType type, std::span<const Vec3> corners);

/// The 27 Bezier coefficients of the Jacobian determinant of a hexahedron, the first index fastest along its edge 0-1, then 0-3, 0-4.
std::array<double, 27> bezier_coefficients(std::span<const Vec3, 8> corners);

}  // namespace geomend::hexes
