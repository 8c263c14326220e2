// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/unfold.h"

#include <algorithm>

#include "geometry/vectors.h"

namespace geomend::arrangement {

namespace {

Vec3 area_vector(std::span<const Vec3> points, const Triangle& t) {
    return cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
}

/// The corner opposite to the longest edge, on that edge, where the triangle is no higher over it than the tolerance.
void add_lone_corner(const FlatTriangle& t, double tolerance, NearFeatures& to) {
    std::array<double, 3> square{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 d = minus(t.corner[(i + 1) % 3], t.corner[i]);
        square[i] = dot(d, d);
    }
    const auto longest = static_cast<std::size_t>(std::ranges::max_element(square) - square.begin());
    const Vec3 n = cross(minus(t.corner[1], t.corner[0]), minus(t.corner[2], t.corner[0]));
    if (dot(n, n) <= tolerance * tolerance * square[longest]) to.on_edges.push_back({t.edge(longest), t.vertex[(longest + 2) % 3]});
}

}  // namespace

bool unfold(CutState& state, const TriangleSoup& soup, double tolerance) {
    const auto& points = state.points.points();
    NearFeatures folded;
    for (std::size_t t = 0; t < state.triangles.size(); ++t) {
        const std::uint32_t source = state.source[t];
        const bool is_stack = source >= soup.triangles.size();
        const Vec3 whole =
            is_stack ? state.stacks[source - soup.triangles.size()].normal : area_vector(soup.vertices, soup.triangles[source]);
        if (dot(area_vector(points, state.triangles[t]), whole) < 0)
            add_lone_corner(FlatTriangle(points, state.triangles[t]), tolerance, folded);
    }
    if (folded.on_edges.empty()) return false;
    state.reach = tolerance;
    return cut_at(state, folded);
}

}  // namespace geomend::arrangement
