// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/single_valued_surfaces.h"

#include <array>
#include <span>

#include "base/parallel.h"
#include "geometry/node_groups.h"
#include "geometry/single_valued.h"

namespace geomend::validators {

namespace {

using Edge = std::array<std::uint32_t, 2>;

bool has_edge(const Triangle& t, std::uint32_t from, std::uint32_t to) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

/// The edges of a surface of triangles but for those that the triangle across has in the opposite direction.
std::vector<Edge> open_edges(const BrepData::Surface& surface, std::span<const Triangle> triangles) {
    std::vector<Edge> open;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles[t][k], to = triangles[t][k == 2 ? 0 : k + 1], across = surface.neighbours[3 * t + k];
            if (across == no_index || !has_edge(triangles[across], to, from)) open.push_back({from, to});
        }
    }
    return open;
}

}  // namespace

std::vector<std::uint32_t> single_valued_surfaces(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint8_t> is_proven(brep.surfaces.size(), 0);
    parallel_for_each_index(brep.surfaces.size(), [&](std::size_t s) {
        const auto& surface = brep.surfaces[s];
        if (!surface.polygons.all_triangles() || scope.stopped()) return;
        const std::uint32_t first = scope.first_triangle(static_cast<std::uint32_t>(s));
        const auto triangles = scope.triangles().subspan(first, surface.polygons.size());
        is_proven[s] = is_single_valued(brep.vertices, triangles, open_edges(surface, triangles)) ? 1 : 0;
    });
    const TriangleTree& tree = scope.tree();
    std::vector<std::uint32_t> groups(tree.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::uint32_t s = scope.surface_of(tree.number(i));
        groups[i] = is_proven[s] != 0 ? s : NodeGroups::mixed;
    }
    return groups;
}

}  // namespace geomend::validators
