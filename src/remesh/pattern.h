// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "remesh/sample_line.h"
#include "remesh/work_surface.h"

namespace geomend::remeshing {

/// Where new vertices are to lie, in place of even spacing by sizes.
struct Pattern {
    /// Places on a line of the model, or a crease behind its lines, from its first to its last point, as of sample_line().
    std::function<std::vector<LineSample>(std::uint32_t line, std::span<const Vec3> points, const LineRules& rules)> on_line;
    /// Places inside of a surface of the model, not at its borders and not at those that are taken.
    std::function<std::vector<SurfacePoint>(std::uint32_t surface, const EdgeMesh& mesh, std::span<const Vec3> taken)> on_surface;
    /// Of the two diagonals of a near-square the better one, so that surfaces beside each other are cut alike; given from end to end.
    std::function<bool(std::uint32_t surface, const Vec3& from, const Vec3& to)> is_better;
    /// Vertices as they would be where the pattern is made of squares; nothing: it is so where they are. Empty: it is so everywhere.
    std::function<std::vector<Vec3>(std::uint32_t surface, std::span<const Vec3> places)> straightened;
};

/// Gives a surface the vertices of a pattern: they are put where they lie, all other vertices inside give way, and edges are turned
/// towards Delaunay triangles, at last where the pattern is made of squares. Vertices of borders are as of remesh_isotropic(). Vertices of
/// the surface as it was stay where sizes have been lowered below `size`. Results depend on the input alone. Cost: linear for each of a few
/// rounds.
void remesh_to_pattern(WorkSurface& work, const Pattern& pattern, std::uint32_t surface, double size);

/// Puts a point of the surface into the mesh, which is the surface still, only finer: into a triangle or onto one of its edges, whichever
/// makes the better triangles. A vertex that is there already stays. \param point on the reference \param from_triangle of the mesh, near
/// it \return the vertex, which is fixed; no_index: only triangles without area would be there
std::uint32_t put_vertex(WorkSurface& work, const SurfacePoint& point, std::uint32_t from_triangle);

/// Lets all vertices give way that are not fixed, as far as shapes allow, and turns edges towards Delaunay triangles.
void leave_fixed_vertices(WorkSurface& work);

}  // namespace geomend::remeshing
