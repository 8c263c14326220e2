// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "geometry/triangle_pair.h"

namespace geomend::bench {

/// A soup as CGAL's surface mesh, to be refined along its own intersections.
class CgalSoup {
public:
    CgalSoup(std::span<const Vec3> vertices, std::span<const Triangle> triangles);
    ~CgalSoup();
    /// Cuts it; gives the number of triangles after. Once only.
    std::size_t autorefine();

private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

}  // namespace geomend::bench
