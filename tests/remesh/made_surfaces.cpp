// SPDX-License-Identifier: AGPL-3.0-or-later
#include "made_surfaces.h"

#include <gtest/gtest.h>

#include <map>

namespace geomend::test {

using remeshing::EdgeMesh;
using remeshing::TriangleQuality;
using remeshing::VertexKind;
using remeshing::WorkSurface;

EdgeMesh mesh_of(const std::vector<Vec3>& places, const std::vector<std::uint32_t>& corners) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
    const auto next = [](std::uint32_t h) { return remeshing::next_of(h); };
    for (std::uint32_t h = 0; h < corners.size(); ++h) edges[{corners[h], corners[next(h)]}] = h / 3;
    std::vector<std::uint32_t> neighbours;
    for (std::uint32_t h = 0; h < corners.size(); ++h) {
        const auto back = edges.find({corners[next(h)], corners[h]});
        neighbours.push_back(back == edges.end() ? no_index : back->second);
    }
    auto made = remeshing::fanned_mesh(places, corners, neighbours);
    EXPECT_TRUE(made.ok());
    return made ? std::move(made->mesh) : EdgeMesh{};
}

EdgeMesh sheet(std::uint32_t nx, std::uint32_t ny, const std::function<double(double, double)>& height) {
    std::vector<Vec3> places;
    std::vector<std::uint32_t> corners;
    for (std::uint32_t j = 0; j <= ny; ++j) {
        for (std::uint32_t i = 0; i <= nx; ++i) places.push_back({double(i), double(j), height ? height(i, j) : 0});
    }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (nx + 1) + i; };
    for (std::uint32_t j = 0; j < ny; ++j) {
        for (std::uint32_t i = 0; i < nx; ++i) {
            for (const std::uint32_t v : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
                corners.push_back(v);
        }
    }
    return mesh_of(places, corners);
}

EdgeMesh closed_cube(std::uint32_t n) {
    std::vector<Vec3> places;
    std::vector<std::uint32_t> corners;
    std::map<Vec3, std::uint32_t> number;
    const auto vertex = [&](const Vec3& p) {
        const auto [at, is_new] = number.emplace(p, static_cast<std::uint32_t>(places.size()));
        if (is_new) places.push_back(p);
        return at->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const bool far : {false, true}) {
            const auto point = [&](double u, double v) {
                Vec3 p{};
                p[axis] = far ? n : 0;
                p[(axis + 1) % 3] = far ? u : v;
                p[(axis + 2) % 3] = far ? v : u;
                return vertex(p);
            };
            for (std::uint32_t i = 0; i < n; ++i) {
                for (std::uint32_t j = 0; j < n; ++j) {
                    for (const std::uint32_t v :
                         {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j), point(i + 1, j + 1), point(i, j + 1)})
                        corners.push_back(v);
                }
            }
        }
    }
    return mesh_of(places, corners);
}

MeshNumbers numbers_of(const EdgeMesh& mesh) {
    MeshNumbers numbers;
    std::uint64_t halves = 0;
    for (std::uint32_t v = 0; v < mesh.places.size(); ++v) numbers.vertices += mesh.has_vertex(v) ? 1 : 0;
    for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
        if (mesh.corners[h] == no_index) continue;
        ++halves;
        if (mesh.twins[h] == no_index) ++numbers.border_edges;
    }
    numbers.triangles = halves / 3;
    numbers.euler = static_cast<std::int64_t>(numbers.vertices) - static_cast<std::int64_t>((halves + numbers.border_edges) / 2) +
                    static_cast<std::int64_t>(numbers.triangles);
    return numbers;
}

WorkSurface with_fixed_borders(const EdgeMesh& reference, std::span<const double> sizes) {
    WorkSurface work = work_surface(reference, {sizes, {}, 0, nullptr});
    for (VertexKind& kind : work.kinds) kind = kind == VertexKind::old ? VertexKind::fixed : kind;
    return work;
}

TriangleQuality quality_of(const EdgeMesh& mesh) {
    TriangleQuality sum;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (mesh.has_triangle(t)) sum.add(mesh.triangle(t));
    }
    return sum;
}

}  // namespace geomend::test
