// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "remesh/edge_mesh.h"
#include "remesh/triangle_quality.h"
#include "remesh/work_surface.h"

namespace geomend::test {

/// A sheet of nx by ny squares of edge 1, each of two triangles, with heights.
remeshing::EdgeMesh sheet(std::uint32_t nx, std::uint32_t ny, const std::function<double(double, double)>& height = {});

/// The six sides of a cube of n by n by n squares; closed.
remeshing::EdgeMesh closed_cube(std::uint32_t n);

/// A mesh of triangles whose neighbours are found by their vertices. \pre no edge has more than two triangles, which turn one way
remeshing::EdgeMesh mesh_of(const std::vector<Vec3>& places, const std::vector<std::uint32_t>& corners);

struct MeshNumbers {
    std::uint64_t vertices = 0, triangles = 0, border_edges = 0;
    std::int64_t euler = 0;
    bool operator==(const MeshNumbers&) const = default;
};
MeshNumbers numbers_of(const remeshing::EdgeMesh& mesh);

/// A mesh to remesh, of which all vertices of borders stay.
remeshing::WorkSurface with_fixed_borders(const remeshing::EdgeMesh& reference, std::span<const double> sizes);

/// Of all triangles that there are.
remeshing::TriangleQuality quality_of(const remeshing::EdgeMesh& mesh);

}  // namespace geomend::test
