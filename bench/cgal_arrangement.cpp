// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cgal_arrangement.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

namespace geomend::bench {

struct CgalSoup::Mesh {
    CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> surface;
};

CgalSoup::CgalSoup(std::span<const Vec3> vertices, std::span<const Triangle> triangles) : mesh_(std::make_unique<Mesh>()) {
    std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
    for (const Vec3& p : vertices) points.emplace_back(p[0], p[1], p[2]);
    std::vector<std::vector<std::size_t>> polygons;
    for (const Triangle& t : triangles) polygons.push_back({t[0], t[1], t[2]});
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, polygons, mesh_->surface);
}

CgalSoup::~CgalSoup() = default;

std::size_t CgalSoup::autorefine() {
    CGAL::Polygon_mesh_processing::experimental::autorefine(mesh_->surface);
    return mesh_->surface.number_of_faces();
}

}  // namespace geomend::bench
