// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/triangle_soup.h"

namespace geomend::bench {

/// The yardstick: a surface as a mesh of CGAL, whose border edges are constrained.
class CgalSurface {
public:
    CgalSurface(std::span<const Vec3> vertices, std::span<const Triangle> triangles);
    ~CgalSurface();

    /// Polygon_mesh_processing::isotropic_remeshing of the whole, constraints protected.
    void remesh(double size, unsigned iterations);
    std::vector<std::array<Vec3, 3>> triangles() const;

private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

}  // namespace geomend::bench
