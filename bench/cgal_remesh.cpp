// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cgal_remesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

namespace geomend::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

struct CgalSurface::Mesh {
    SurfaceMesh surface;
};

CgalSurface::CgalSurface(std::span<const Vec3> vertices, std::span<const Triangle> triangles) : mesh_(std::make_unique<Mesh>()) {
    std::vector<SurfaceMesh::Vertex_index> number;
    for (const Vec3& p : vertices) number.push_back(mesh_->surface.add_vertex({p[0], p[1], p[2]}));
    for (const Triangle& t : triangles) mesh_->surface.add_face(number[t[0]], number[t[1]], number[t[2]]);
}

CgalSurface::~CgalSurface() = default;

void CgalSurface::remesh(double size, unsigned iterations) {
    SurfaceMesh& mesh = mesh_->surface;
    auto [constrained, added] = mesh.add_property_map<SurfaceMesh::Edge_index, bool>("e:constrained", false);
    for (const auto e : mesh.edges()) constrained[e] = mesh.is_border(e);
    namespace params = CGAL::parameters;
    CGAL::Polygon_mesh_processing::isotropic_remeshing(
        mesh.faces(), size, mesh, params::number_of_iterations(iterations).protect_constraints(true).edge_is_constrained_map(constrained));
}

std::vector<std::array<Vec3, 3>> CgalSurface::triangles() const {
    const SurfaceMesh& mesh = mesh_->surface;
    std::vector<std::array<Vec3, 3>> all;
    for (const auto f : mesh.faces()) {
        std::array<Vec3, 3>& t = all.emplace_back();
        std::size_t k = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
            const auto& p = mesh.point(v);
            t[k++] = {p.x(), p.y(), p.z()};
        }
    }
    return all;
}

}  // namespace geomend::bench
