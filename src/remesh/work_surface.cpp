// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/work_surface.h"

#include <algorithm>
#include <cmath>

#include "base/length.h"
#include "base/vectors.h"

namespace geomend::remeshing {

double size_at(const WorkSurface& work, const SurfacePoint& at) {
    const VertexSizes& sizes = work.reference_sizes;
    double between = 0, most = 0, grown = HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = work.reference->corners[3 * std::size_t{at.triangle} + k];
        between += at.weights[k] * sizes.at[v];
        if (sizes.most.empty()) continue;
        most += at.weights[k] * sizes.most[v];
        grown = std::min(grown, sizes.at[v] + sizes.growth * length(minus(at.place, work.reference->places[v])));
    }
    const double size = std::max(between, std::min(most, grown));
    return sizes.limit != nullptr ? std::min(size, (*sizes.limit)(at.place)) : size;
}

WorkSurface work_surface(const EdgeMesh& reference, const VertexSizes& sizes) {
    WorkSurface work;
    work.reference = &reference;
    work.reference_sizes = sizes;
    work.mesh = reference;
    work.sizes.assign(sizes.at.begin(), sizes.at.end());
    work.names.assign(sizes.at.size(), no_index);
    for (std::uint32_t v = 0; v < sizes.at.size(); ++v) {
        work.triangles.push_back(reference.leaving[v] / 3);
        work.kinds.push_back(reference.on_border(v) ? VertexKind::old : VertexKind::inner);
    }
    return work;
}

namespace {

/// States what a new vertex is.
void describe(WorkSurface& work, std::uint32_t v, const SurfacePoint& at, VertexKind kind) {
    if (v == work.kinds.size()) {
        work.sizes.emplace_back();
        work.triangles.emplace_back();
        work.kinds.emplace_back();
        work.names.emplace_back();
    }
    work.sizes[v] = size_at(work, at);
    work.triangles[v] = at.triangle;
    work.kinds[v] = kind;
    work.names[v] = no_index;
}

}  // namespace

std::uint32_t add_on_edge(WorkSurface& work, std::uint32_t h, const Vec3& place, const SurfacePoint& at, VertexKind kind) {
    const std::uint32_t v = split_edge(work.mesh, h, place);
    describe(work, v, at, kind);
    return v;
}

std::uint32_t add_in_triangle(WorkSurface& work, std::uint32_t triangle, const Vec3& place, const SurfacePoint& at, VertexKind kind) {
    const std::uint32_t v = split_face(work.mesh, triangle, place);
    describe(work, v, at, kind);
    return v;
}

void put_at(WorkSurface& work, std::uint32_t v, const SurfacePoint& at) {
    work.mesh.places[v] = at.place;
    work.triangles[v] = at.triangle;
    work.sizes[v] = size_at(work, at);
}

void FoldGuard::add(const Vec3& a, const Vec3& b, const Vec3& c) { facing = plus(facing, cross(minus(b, a), minus(c, a))); }

bool FoldGuard::admits(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 normal = cross(minus(b, a), minus(c, a));
    const double along = dot(normal, facing);
    return along > 0 && along * along > least * least * dot(normal, normal) * dot(facing, facing);
}

double shape_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(b, a), v = minus(c, b), w = minus(a, c);
    const Vec3 normal = cross(u, v);
    const double squares = dot(u, u) + dot(v, v) + dot(w, w);
    return squares > 0 ? 2 * std::sqrt(3.0) * std::sqrt(dot(normal, normal)) / squares : 0;
}

double cotangent(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(a, c), v = minus(b, c), n = cross(u, v);
    const double sine = std::sqrt(dot(n, n));
    return sine > 0 ? dot(u, v) / sine : HUGE_VAL;
}

}  // namespace geomend::remeshing
