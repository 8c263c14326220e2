// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "geometry/triangle_pair.h"
#include "validators/cell_scope.h"

namespace geomend::validators {

/// A triangle of an outer face of a mesh of cells.
struct OuterTriangle {
    std::uint32_t face;  ///< of CellScope::faces()
    Vec3 normal;         ///< points out of the cell; as long as twice the area
};

/// The faces that only one cell has, as triangles: bent ones by the rule of all of us, the fan of the lowest corner.
struct OuterFaces {
    std::vector<Triangle> triangles;  ///< of points of the mesh, equal positions being one
    std::vector<OuterTriangle> of;    ///< per triangle
};

/// Cost: linear.
OuterFaces outer_faces(const CellScope& scope);

}  // namespace geomend::validators
