// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cgal_intersections.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <utility>

namespace geomend::bench {

namespace {

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Inexact::Point_3>;

}  // namespace

struct CgalMesh::Mesh {
    SurfaceMesh surface;
};

CgalMesh::CgalMesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles) : mesh_(std::make_unique<Mesh>()) {
    std::vector<Inexact::Point_3> points;
    for (const Vec3& p : vertices) points.emplace_back(p[0], p[1], p[2]);
    std::vector<std::vector<std::size_t>> polygons;
    for (const Triangle& t : triangles) polygons.push_back({t[0], t[1], t[2]});
    CGAL::Polygon_mesh_processing::orient_polygon_soup(points, polygons);
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, polygons, mesh_->surface);
}

CgalMesh::~CgalMesh() = default;

std::vector<std::array<std::uint32_t, 2>> CgalMesh::self_intersections() const {
    std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(mesh_->surface, std::back_inserter(found));
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const auto& [a, b] : found) pairs.push_back({std::min<std::uint32_t>(a, b), std::max<std::uint32_t>(a, b)});
    return pairs;
}

int common_dimension_by_cgal(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b) {
    const auto corner = [&](std::uint32_t v) { return Exact::Point_3(vertices[v][0], vertices[v][1], vertices[v][2]); };
    const Exact::Triangle_3 p(corner(a[0]), corner(a[1]), corner(a[2])), q(corner(b[0]), corner(b[1]), corner(b[2]));
    const auto common = CGAL::intersection(p, q);
    if (!common) return 0;
    if (boost::get<Exact::Point_3>(&*common) != nullptr) return 1;
    if (boost::get<Exact::Segment_3>(&*common) != nullptr) return 2;
    return 3;
}

}  // namespace geomend::bench
