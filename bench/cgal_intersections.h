// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/triangle_pair.h"

namespace geomend::bench {

/// The yardstick: the same triangles as a mesh of CGAL, oriented, with vertices split where more than two triangles meet.
class CgalMesh {
public:
    CgalMesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles);
    ~CgalMesh();

    /// Polygon_mesh_processing::self_intersections, sequential: pairs of triangle numbers. Triangles that meet at a vertex
    /// that was split are among them.
    std::vector<std::array<std::uint32_t, 2>> self_intersections() const;

private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

/// What two triangles have in common, by exact constructions: 0 nothing, 1 a point, 2 a segment, 3 an area.
int common_dimension_by_cgal(std::span<const Vec3> vertices, const Triangle& a, const Triangle& b);

}  // namespace geomend::bench
