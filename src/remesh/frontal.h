// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "remesh/isotropic.h"

namespace geomend::remeshing {

struct FrontalRules {
    double apart = 0.8;          ///< of the size at a point: no other one is nearer
    double from_border = 0.68;   ///< of it, from borders
    unsigned relaxing = 4;       ///< rounds in which vertices move
    double polished_below = 38;  ///< degrees, as of IsotropicRules
    IsotropicRules start{4, 0};  ///< how the mesh is made that takes the points
};

/// A point inside of a surface, the third corner of an equilateral triangle over an edge between others.
struct FrontalPoint {
    SurfacePoint at;       ///< on the reference
    std::uint32_t beside;  ///< the point of which that edge is: a vertex of the mesh, or, from `vertices` on, one of these points
    double size = 0;
};

/// Points from the borders inwards: on either side of each edge of the front the one that makes an equilateral triangle of the size
/// there, unless another point or a border is too near; then its edges to the points around are the front. A point of another sheet,
/// which faces the other way, counts as far.
/// \param vertices the number of those of the mesh
/// Source: A. Botella (2016), 2.5.1 and 2.5.3. Cost: some 20 microseconds for each point.
std::vector<FrontalPoint> frontal_points(const WorkSurface& work, const FrontalRules& rules);

/// Gives a surface frontal points as vertices: all others inside give way, edges are turned towards Delaunay triangles, and vertices relax.
/// What remesh_isotropic() promises holds here. Cost: about three times that of it.
void remesh_frontal(WorkSurface& work, const FrontalRules& rules);

}  // namespace geomend::remeshing
