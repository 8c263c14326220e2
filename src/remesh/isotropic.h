// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "remesh/work_surface.h"

namespace geomend::remeshing {

struct IsotropicRules {
    unsigned rounds = 6;         ///< of splitting, collapsing, turning and moving
    double polished_below = 34;  ///< degrees: triangles with such an angle are worked on in the end
};

/// Brings the edges of a surface to the sizes at their ends and its triangles towards equilateral ones: long edges are split, short
/// ones collapse, edges are turned where angles across them are too large together, and inner vertices move along the surface. What
/// it does has no effect on borders but that old vertices of them give way. Inner vertices stay on the reference, nothing folds, and
/// the surface remains what it is: no hole is closed, no border pinched. Old vertices that could not give way are left.
/// After M. Botsch and L. Kobbelt, "A remeshing approach to multiresolution modeling" (2004), with Delaunay flips in place of valences.
/// Results do not depend on anything but the input. Cost: linear in the triangles of both meshes for each round.
void remesh_isotropic(WorkSurface& work, const IsotropicRules& rules);

/// The same without the work on single triangles in the end.
void even_out(WorkSurface& work, const IsotropicRules& rules);

/// The parts of it. Each returns the number of changes.
std::size_t split_long_edges(WorkSurface& work);
/// \return whether it was split: not where the surface is not near its middle. \pre an inner edge
bool split_at_middle(WorkSurface& work, std::uint32_t h);
std::size_t collapse_short_edges(WorkSurface& work);
std::size_t remove_old_vertices(WorkSurface& work);
std::size_t flip_edges(WorkSurface& work);
std::size_t move_vertices(WorkSurface& work);
/// Moves a vertex to the point of the reference next to a place, where nothing folds by it and the worst triangle around does not become
/// worse than fair. \param improves the worst triangle around must become better \return whether it was moved
bool try_move(WorkSurface& work, std::uint32_t v, const Vec3& to, bool improves);

}  // namespace geomend::remeshing
