// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/length.h"
#include "base/vectors.h"
#include "geometry/triangle_tree.h"
#include "volume/surface_points.h"

namespace geomend::volumes {

namespace {

/// The facets that no cell has as a face.
std::vector<std::uint32_t> facets_that_are_no_faces(const RegionFacets& facets, const Tetrahedra& all) {
    std::vector<Triangle> faces;
    for (const auto& c : all.cells) {
        for (std::size_t k = 0; k < 4; ++k) {
            Triangle face{c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
            std::ranges::sort(face);
            if (face[2] < facets.positions.size()) faces.push_back(face);
        }
    }
    std::ranges::sort(faces);
    std::vector<std::uint32_t> missing;
    for (std::uint32_t f = 0; f < facets.triangles.size(); ++f) {
        Triangle facet = facets.triangles[f];
        std::ranges::sort(facet);
        if (!std::ranges::binary_search(faces, facet)) missing.push_back(f);
    }
    return missing;
}

/// Up to which distance a point that was computed to lie on a facet lies on it: its share of the facet's size, or the steps of coordinates.
double rounding(const std::array<Vec3, 3>& t) {
    double size = 0, far = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        size = std::max(size, length(minus(t[(k + 1) % 3], t[k])));
        for (const double x : t[k]) far = std::max(far, std::abs(x));
    }
    return std::max(1e-9 * size, 16 * std::numeric_limits<double>::epsilon() * far);
}

/// Where a point lies on a facet: the number of an edge (from that corner on), 3 inside; none beside it or at a corner.
std::optional<unsigned> place_on(const std::array<Vec3, 3>& t, const Vec3& p) {
    const double near = rounding(t);
    const Vec3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double area = length(normal);
    if (!(area > 0) || std::abs(dot(normal, minus(p, t[0]))) > near * area) return std::nullopt;
    std::optional<unsigned> edge;
    for (unsigned k = 0; k < 3; ++k) {
        if (length(minus(p, t[k])) <= near) return std::nullopt;
        const Vec3 along = minus(t[(k + 1) % 3], t[k]);
        const double height = dot(cross(normal, along), minus(p, t[k])) / (area * length(along));
        if (height < -near) return std::nullopt;
        if (height <= near) edge = k;
    }
    return edge.value_or(3);
}

}  // namespace

SurfacePoints points_on_facets(const RegionFacets& facets, const Tetrahedra& all) {
    SurfacePoints points;
    const auto missing = facets_that_are_no_faces(facets, all);
    const auto corners_of = [&](std::uint32_t f) {
        const Triangle& t = facets.triangles[f];
        return std::array<Vec3, 3>{facets.positions[t[0]], facets.positions[t[1]], facets.positions[t[2]]};
    };
    std::vector<Triangle> triangles;
    double reach = 0;
    for (const std::uint32_t f : missing) {
        triangles.push_back(facets.triangles[f]);
        reach = std::max(reach, rounding(corners_of(f)));
    }
    if (triangles.empty() || all.new_vertices.empty()) return points;
    const TriangleTree tree(facets.positions, triangles);
    for (const Vec3& p : all.new_vertices) {
        std::optional<std::pair<std::uint32_t, unsigned>> found;  // facet, place; on an edge rather than inside
        tree.visit_triangles(tree.box(p, p, reach), [&](std::size_t i) {
            const std::uint32_t f = missing[tree.number(i)];
            const auto place = place_on(corners_of(f), p);
            if (place && (!found || *place < found->second)) found = {f, *place};
        });
        if (!found) continue;
        const auto [f, place] = *found;
        Triangle corners = facets.triangles[f];
        for (std::uint32_t& v : corners) v = facets.vertices[v];
        if (place == 3) {
            points.inside.push_back({facets.surfaces[f], corners, p});
        } else {
            const auto [low, high] = std::minmax(corners[place], corners[(place + 1) % 3]);
            points.on_edges.push_back({{low, high}, p});
        }
    }
    return points;
}

}  // namespace geomend::volumes
