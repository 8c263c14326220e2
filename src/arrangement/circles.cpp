// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/circles.h"

#include <algorithm>

#include "arrangement/segment_contact.h"
#include "base/disjoint_sets.h"
#include "geometry/vectors.h"

namespace geomend::arrangement {

namespace {

constexpr double thin = 2;                ///< tolerances
constexpr std::size_t most_corners = 24;  ///< of a polygon: more are no circle

std::vector<Link> edges_with_findings(const NearFeatures& found) {
    std::vector<Link> edges;
    for (const VertexOnEdge& v : found.on_edges) edges.push_back(v.edge);
    for (const NewPoint& p : found.points) {
        edges.push_back(p.edge);
        if (!p.pierces) edges.push_back(p.other);
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// The triangles of each polygon, one polygon after the other, by their first triangle.
std::vector<std::vector<std::uint32_t>> polygons(const CutState& state, const NearFeatures& found) {
    struct Use {
        Link edge;
        std::uint32_t source, index;
        auto operator<=>(const Use&) const = default;
    };
    const auto touched = edges_with_findings(found);
    std::vector<std::uint32_t> fresh;
    std::vector<Use> uses;
    for (std::uint32_t t = 0; t < state.triangles.size(); ++t) {
        if (state.is_new[t] == 0) continue;
        const auto index = static_cast<std::uint32_t>(fresh.size());
        fresh.push_back(t);
        for (std::size_t i = 0; i < 3; ++i) {
            const Link edge(state.triangles[t][i], state.triangles[t][(i + 1) % 3]);
            if (std::ranges::binary_search(touched, edge)) uses.push_back({edge, state.source[t], index});
        }
    }
    std::sort(uses.begin(), uses.end());
    DisjointSets together(fresh.size());
    for (std::size_t i = 1; i < uses.size(); ++i) {
        if (uses[i].edge == uses[i - 1].edge && uses[i].source == uses[i - 1].source) together.join(uses[i].index, uses[i - 1].index);
    }
    const auto root = std::move(together).roots();
    std::vector<std::vector<std::uint32_t>> all(fresh.size());
    for (std::uint32_t i = 0; i < fresh.size(); ++i) all[root[i]].push_back(fresh[i]);
    std::erase_if(all, [](const auto& triangles) { return triangles.size() < 2; });
    return all;
}

struct Corner {
    double along = 0;  ///< the line, from one end
    std::uint32_t vertex = 0;
    auto operator<=>(const Corner&) const = default;
};

/// The two that are farthest from each other.
Link farthest_of(std::span<const Vec3> points, const std::vector<std::uint32_t>& corners) {
    Link ends(corners[0], corners[0]);
    double longest = -1;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            const Vec3 d = minus(points[corners[j]], points[corners[i]]);
            if (dot(d, d) <= longest) continue;
            longest = dot(d, d);
            ends = Link(corners[i], corners[j]);
        }
    }
    return ends;
}

/// Corners along the line between the two that are farthest from each other; empty where one is farther from it than `width`.
std::vector<Corner> in_one_line(std::span<const Vec3> points, const std::vector<std::uint32_t>& corners, double width) {
    const Link ends = farthest_of(points, corners);
    const Vec3 from_end = minus(points[ends.b], points[ends.a]), direction = times(1 / length(from_end), from_end);
    std::vector<Corner> line;
    for (const std::uint32_t v : corners) {
        const Vec3 w = minus(points[v], points[ends.a]);
        const double along = dot(w, direction);
        const Vec3 off = minus(w, times(along, direction));
        if (dot(off, off) > width * width) return {};
        line.push_back({along, v});
    }
    std::sort(line.begin(), line.end());
    return line;
}

/// Whatever runs from one corner to another passes all those between.
void put_on_line(const std::vector<Corner>& line, NearFeatures& found) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        for (std::size_t j = i + 2; j < line.size(); ++j) {
            for (std::size_t k = i + 1; k < j; ++k) found.on_edges.push_back({Link(line[i].vertex, line[j].vertex), line[k].vertex});
        }
    }
}

/// Half-way between the corners off the longest line and that line: near them, so that they are seen from it under wide angles.
Vec3 middle_of(std::span<const Vec3> points, const std::vector<std::uint32_t>& corners) {
    const Link ends = farthest_of(points, corners);
    Vec3 sum{};
    for (const std::uint32_t v : corners) {
        if (!ends.has(v)) sum = plus(sum, points[v]);
    }
    const Vec3 mean = times(1 / static_cast<double>(corners.size() - 2), sum);
    const Vec3 direction = minus(points[ends.b], points[ends.a]), w = minus(mean, points[ends.a]);
    const Vec3 foot = plus(points[ends.a], times(dot(w, direction) / dot(direction, direction), direction));
    return rounded(times(0.5, plus(mean, foot)));
}

/// The triangle that has a point of its plane deepest inside.
std::uint32_t triangle_at(const CutState& state, const std::vector<std::uint32_t>& triangles, const Vec3& x) {
    std::uint32_t best = triangles.front();
    double deepest = -HUGE_VAL;
    for (const std::uint32_t t : triangles) {
        const FlatTriangle flat(state.points.points(), state.triangles[t]);
        double depth = HUGE_VAL;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 edge = minus(flat.corner[(i + 1) % 3], flat.corner[i]);
            depth = std::min(depth, dot(cross(flat.normal, edge), minus(x, flat.corner[i])) / length(edge));
        }
        if (depth <= deepest) continue;
        deepest = depth;
        best = t;
    }
    return best;
}

void put_point_in_middle(CutState& state, const std::vector<std::uint32_t>& triangles, const std::vector<std::uint32_t>& corners,
                         NearFeatures& found) {
    if (corners.size() < 4) return;
    const Vec3 middle = middle_of(state.points.points(), corners);
    const std::uint32_t vertex = state.points.add(middle);
    if (!std::ranges::binary_search(corners, vertex)) found.on_faces.push_back({triangle_at(state, triangles, middle), vertex});
}

}  // namespace

void break_circles(CutState& state, NearFeatures& found, double tolerance) {
    for (const auto& triangles : polygons(state, found)) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t t : triangles) corners.insert(corners.end(), state.triangles[t].begin(), state.triangles[t].end());
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        if (corners.size() > most_corners) continue;
        const auto line = in_one_line(state.points.points(), corners, thin * tolerance);
        if (line.empty()) put_point_in_middle(state, triangles, corners, found);
        else put_on_line(line, found);
    }
}

}  // namespace geomend::arrangement
