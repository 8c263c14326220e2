// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "remesh/isotropic.h"

namespace geomend::remeshing {

struct CentroidalRules {
    IsotropicRules start;        ///< how the first vertices are found
    unsigned most_rounds = 120;  ///< in each of which all vertices move
    double least_step = 0.003;   ///< rounds end where no more than a hundredth of the vertices move by more than this share of its size
    double polished_below = 38;  ///< degrees, as of IsotropicRules
};

/// Vertices of a surface as a centroidal Voronoi tessellation of it, its border fixed: each inner vertex lies at the centroid of its
/// Voronoi cell on the surface, in a density of 1 by the fourth power of the size there, and the triangles are their Delaunay ones. This
/// is where the energy of Q. Du et al. (1999) is least; after J. Pellerin (2014), chapter 4, with Voronoi cells along the surface (over
/// its triangles) in place of cells in space, so that sheets that lie close to each other share none, and with Lloyd's steps, lengthened.
/// What isotropic remeshing promises holds here. Cost: two to five times that of it.
void remesh_centroidal(WorkSurface& work, const CentroidalRules& rules);

/// One round of it. \return the number of vertices that moved by more than this share of their size
std::size_t move_to_centroids(WorkSurface& work, double share);

}  // namespace geomend::remeshing
