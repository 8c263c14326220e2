// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "remesh/edge_mesh.h"
#include "remesh/reference_surface.h"
#include "remesh/vertex_sizes.h"

namespace geomend::remeshing {

/// What may be done with a vertex.
enum class VertexKind : std::uint8_t {
    inner,  ///< anything
    fixed,  ///< nothing: it is one of the new line, or stands on its own
    old     ///< a vertex of a border as it was read: it is to give way along the border
};

/// A surface while its triangles are changed, beside the surface as it was read.
struct WorkSurface {
    const EdgeMesh* reference = nullptr;
    VertexSizes reference_sizes;  ///< at the vertices of the reference
    EdgeMesh mesh;
    std::vector<double> sizes;             ///< per vertex: edges there should be so long
    std::vector<std::uint32_t> triangles;  ///< per vertex one of the reference at which it lies
    std::vector<VertexKind> kinds;
    std::vector<std::uint32_t> names;           ///< per vertex the caller's number of a fixed one
    std::uint32_t most_triangles = UINT32_MAX;  ///< no edge is split where there are as many
    const Monitor* monitor = nullptr;           ///< what is done ends early where this is stopped

    bool stopped() const { return monitor != nullptr && monitor->stopped(); }
    /// The same, looked up for one of some thousand items only.
    bool stopped_at(std::uint32_t item) const { return (item & 0xfff) == 0 && stopped(); }
};

/// The size at a point of the reference.
double size_at(const WorkSurface& work, const SurfacePoint& at);

/// The reference as it is, all vertices inner ones but those on borders, which are old.
WorkSurface work_surface(const EdgeMesh& reference, const VertexSizes& sizes);

/// Puts a vertex on an edge. \param at where it lies on the reference \return its number
std::uint32_t add_on_edge(WorkSurface& work, std::uint32_t h, const Vec3& place, const SurfacePoint& at, VertexKind kind);

/// Puts a vertex elsewhere on the reference.
void put_at(WorkSurface& work, std::uint32_t v, const SurfacePoint& at);

/// Puts a vertex inside of a triangle. \param at as of add_on_edge() \return its number
std::uint32_t add_in_triangle(WorkSurface& work, std::uint32_t triangle, const Vec3& place, const SurfacePoint& at, VertexKind kind);

/// What changes around an edge or a vertex must keep to: triangles face the same way as those that they take the place of.
struct FoldGuard {
    Vec3 facing{};        ///< sum of the old normals, of twice the area each
    double least = 0.25;  ///< least cosine between that and a new normal

    void add(const Vec3& a, const Vec3& b, const Vec3& c);
    bool admits(const Vec3& a, const Vec3& b, const Vec3& c) const;
};

/// Shape of a triangle: 1 where it is equilateral, 0 where it has no area. It is 4 sqrt(3) area by the sum of the squares of its edges.
double shape_of(const Vec3& a, const Vec3& b, const Vec3& c);

/// Cosine by sine of the angle at c.
double cotangent(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace geomend::remeshing
