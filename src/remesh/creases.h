// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "model/brep.h"

namespace geomend::remeshing {

struct CreaseRules {
    double angle = 0.7;  ///< radians between the normals on both sides, above which an edge is sharp
    double height = 0;   ///< each side's far corner is at least so far from the plane of the other side
    double length = 0;   ///< creases that are shorter do not count
};

/// A model whose surfaces are cut along their creases, as if these were lines: they come behind the lines of the model, with corners
/// behind its corners, and no triangle has a neighbour across them. Nodes stay common to both sides. Polygons other than triangles
/// are passed over. Cost: linear in triangles, n log n in creases.
BrepData cut_at_creases(const BrepData& brep, const CreaseRules& rules);

}  // namespace geomend::remeshing
