// SPDX-License-Identifier: AGPL-3.0-or-later
#include "complexity/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geomend::complexity {

Vec3 moved(const Vec3& a, const Vec3& b, double t) { return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]}; }

namespace {

// Where the triangles of a fan have the edges of their polygon: edge i of k is edge `second` of triangle `first`.
std::pair<std::uint32_t, std::uint32_t> edge_in_fan(std::uint32_t first_triangle, std::size_t i, std::size_t k) {
    if (i == 0) return {first_triangle, 0};
    if (i == k - 1) return {first_triangle + static_cast<std::uint32_t>(k) - 3, 2};
    return {first_triangle + static_cast<std::uint32_t>(i) - 1, 1};
}

// The edge of polygon q that runs from node b to node a.
std::size_t edge_from_to(std::span<const std::uint32_t> polygon, std::uint32_t from, std::uint32_t to) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::uint32_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if ((a == from && b == to) || (a == to && b == from)) return i;
    }
    return polygon.size();
}

}  // namespace

SurfaceTriangles triangulated(const BrepData::Surface& surface) {
    SurfaceTriangles out;
    std::vector<std::uint32_t> first(surface.polygons.size());
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        first[p] = static_cast<std::uint32_t>(out.triangles.size());
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            out.triangles.push_back(
                {surface.nodes[polygon[0]].value, surface.nodes[polygon[i]].value, surface.nodes[polygon[i + 1]].value});
            const auto self = static_cast<std::uint32_t>(out.triangles.size()) - 1;
            out.across.push_back({i > 1 ? self - 1 : no_index, no_index, i + 2 < polygon.size() ? self + 1 : no_index});
        }
    }
    std::size_t corner = 0;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        for (std::size_t i = 0; i < polygon.size(); ++i, ++corner) {
            const std::uint32_t q = surface.neighbours[corner];
            if (q == no_index || polygon.size() < 3 || surface.polygons[q].size() < 3) continue;
            const std::size_t j = edge_from_to(surface.polygons[q], polygon[i], polygon[(i + 1) % polygon.size()]);
            if (j == surface.polygons[q].size()) continue;
            const auto [mine, edge] = edge_in_fan(first[p], i, polygon.size());
            out.across[mine][edge] = edge_in_fan(first[q], j, surface.polygons[q].size()).first;
        }
    }
    return out;
}

MeasuredModel::MeasuredModel(const BrepData& data) : brep(data), points(data.vertices) {
    constexpr double far = std::numeric_limits<double>::max();
    Vec3 low{far, far, far}, high{-far, -far, -far};
    for (const Vec3& p : points) {
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    if (!points.empty()) origin = {low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2, low[2] / 2 + high[2] / 2};
    for (Vec3& p : points) p = minus(p, origin);
    for (const auto& s : brep.surfaces) surfaces.push_back(triangulated(s));

    box_by_role = std::ranges::any_of(brep.surfaces, [](const auto& s) { return s.role == FeatureRole::boundary; });
    surface_in_box.resize(brep.surfaces.size());
    line_in_box.resize(brep.lines.size());
    std::vector<std::uint8_t> vertex_in_box(points.size());
    for (std::size_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        const bool outside = surface.regions[0].valid() != surface.regions[1].valid();
        surface_in_box[s] = box_by_role ? surface.role == FeatureRole::boundary : outside;
        if (surface_in_box[s] == 0) continue;
        for (const auto& line : surface.lines) line_in_box[line.line.value] = 1;
        for (const VertexId v : surface.nodes) vertex_in_box[v.value] = 1;
    }
    corner_left_out.assign(brep.corners.size(), 1);
    for (const auto& line : brep.lines) {
        if (line.closed()) continue;
        for (const CornerId c : line.corners) corner_left_out[c.value] = vertex_in_box[brep.corners[c.value].vertex.value];
    }

    closed = !brep.regions.empty();
    for (const auto& region : brep.regions) {
        closed = closed && region.volume_known && std::isfinite(region.volume) && region.volume != 0 && !region.sides.empty();
        volume += std::abs(region.volume);
    }
}

Vec3 MeasuredModel::area_vector(const std::array<std::uint32_t, 3>& t) const {
    const Vec3 twice = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
    return {twice[0] / 2, twice[1] / 2, twice[2] / 2};
}

double MeasuredModel::area(const std::array<std::uint32_t, 3>& t) const { return length(area_vector(t)); }

}  // namespace geomend::complexity
