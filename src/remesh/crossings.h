// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "remesh/reference_surface.h"

namespace geomend::remeshing {

/// Follows a straight edge from one point to another along a surface below or above it, and calls visit(walk) wherever it
/// passes over an edge of the surface. Beside the corners of both it is there that two surfaces of
/// flat triangles are farthest from each other. Ends where the surface ends or turns back.
/// \param start the point of the surface below the edge's first end. Cost: some 50 ns for each triangle on the way.
template <class Visit>
void visit_crossings(const EdgeMesh& mesh, const Vec3& from, const Vec3& to, const SurfacePoint& start, const Visit& visit);

/// The step of it: the next edge of the surface that is passed over.
class CrossingWalk {
public:
    CrossingWalk(const EdgeMesh& mesh, const Vec3& from, const Vec3& to, const SurfacePoint& start);
    /// \return false at the end
    bool next();
    std::uint32_t triangle() const { return triangle_; }  ///< before the edge
    const Vec3& on_surface() const { return on_surface_; }
    const Vec3& on_edge() const { return on_edge_; }

private:
    bool leave(std::uint32_t triangle, std::uint32_t entered);

    const EdgeMesh& mesh_;
    Vec3 from_, along_, across_{};
    double square_;               ///< of the edge's length
    double way_ = 0;              ///< share of the edge that is done
    std::uint32_t at_, entered_;  ///< triangle to leave next, and its half-edge through which it was entered
    std::uint32_t first_vertex_ = no_index;
    std::uint32_t triangle_ = no_index;
    Vec3 on_surface_{}, on_edge_{};
    std::uint32_t steps_ = 0;
};

template <class Visit>
void visit_crossings(const EdgeMesh& mesh, const Vec3& from, const Vec3& to, const SurfacePoint& start, const Visit& visit) {
    for (CrossingWalk walk(mesh, from, to, start); walk.next();) visit(walk);
}

}  // namespace geomend::remeshing
