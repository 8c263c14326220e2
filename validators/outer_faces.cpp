// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/outer_faces.h"

#include <cstddef>
#include <cstdint>

#include "geometry/vectors.h"

namespace geomend::validators {

namespace {

Vec3 middle_of_nodes(const CellMesh& mesh, std::uint32_t cell) {
    Vec3 sum{};
    const auto nodes = mesh.cell_nodes(cell);
    const Vec3& o = mesh.points[nodes[0]];
    for (const std::uint32_t node : nodes) sum = plus(sum, minus(mesh.points[node], o));
    return plus(o, times(1.0 / static_cast<double>(nodes.size()), sum));
}

}  // namespace

OuterFaces outer_faces(const CellScope& scope) {
    OuterFaces outer;
    const auto& points = scope.mesh().points;
    for (std::size_t g = 0; g + 1 < scope.group_first().size(); ++g) {
        if (scope.group_first()[g + 1] - scope.group_first()[g] != 1) continue;
        const std::uint32_t f = scope.grouped()[scope.group_first()[g]];
        const auto nodes = scope.nodes_of(scope.faces()[f]);
        std::size_t lowest = 0;
        for (std::size_t i = 1; i < nodes.size(); ++i) {
            if (scope.vertex_of()[nodes[i]] < scope.vertex_of()[nodes[lowest]]) lowest = i;
        }
        const auto at = [&](std::size_t i) { return scope.vertex_of()[nodes[(lowest + i) % nodes.size()]]; };
        const Vec3 inside = middle_of_nodes(scope.mesh(), scope.faces()[f].cell);
        for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
            const Triangle t{at(0), at(i), at(i + 1)};
            if (t[0] == t[1] || t[1] == t[2] || t[0] == t[2]) continue;
            Vec3 normal = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
            if (dot(normal, minus(inside, points[t[0]])) > 0) normal = times(-1, normal);
            outer.triangles.push_back(t);
            outer.of.push_back({f, normal});
        }
    }
    return outer;
}

}  // namespace geomend::validators
