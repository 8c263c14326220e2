// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/faces_from_surfaces.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <variant>

namespace geomend::topology {

namespace {

struct Range {
    std::size_t first, last;
};

Range points_of(const Surface& s, std::size_t part) {
    if (s.parts.empty()) return {0, s.points.size()};
    return {part == 0 ? 0 : s.parts[part].first_point, part + 1 < s.parts.size() ? s.parts[part + 1].first_point : s.points.size()};
}

Range polygons_of(const Surface& s, std::size_t part) {
    if (s.parts.empty()) return {0, s.polygons.size()};
    return {part == 0 ? 0 : s.parts[part].first_polygon, part + 1 < s.parts.size() ? s.parts[part + 1].first_polygon : s.polygons.size()};
}

}  // namespace

Attribute restricted(const Attribute& attribute, const std::vector<std::uint32_t>& indices, AttributeLocation location) {
    Attribute result = without_values(attribute);
    result.location = location;
    std::visit(
        [&](const auto& from) {
            std::decay_t<decltype(from)> values;
            values.reserve(indices.size() * attribute.components);
            for (const std::uint32_t i : indices) {
                const auto at = from.begin() + static_cast<std::ptrdiff_t>(std::size_t{i} * attribute.components);
                values.insert(values.end(), at, at + attribute.components);
            }
            result.values = std::move(values);
        },
        attribute.values);
    return result;
}

namespace {

void add_attributes(const Surface& surface, const std::vector<std::uint32_t>& points, const std::vector<std::uint32_t>& polygons,
                    BrepData::Surface& to) {
    for (const Attribute& a : surface.info.attributes) {
        if (a.location == AttributeLocation::point) to.attributes.push_back(restricted(a, points, a.location));
        if (a.location == AttributeLocation::polygon || a.location == AttributeLocation::cell)
            to.attributes.push_back(restricted(a, polygons, AttributeLocation::polygon));
        if (a.location == AttributeLocation::object) to.attributes.push_back(a);
    }
}

}  // namespace

std::size_t part_count(const Surface& surface) { return surface.parts.empty() ? 1 : surface.parts.size(); }

BrepData::Surface surface_of_part(const Surface& surface, std::uint32_t part, const std::vector<std::uint32_t>& vertex_of) {
    BrepData::Surface result;
    const Range points = points_of(surface, part), polygons = polygons_of(surface, part);
    std::vector<std::uint32_t> used(points.last - points.first);
    std::iota(used.begin(), used.end(), static_cast<std::uint32_t>(points.first));
    std::unordered_map<std::uint32_t, std::uint32_t> foreign;
    const auto node_of = [&](std::uint32_t point) {
        if (point >= points.first && point < points.last) return static_cast<std::uint32_t>(point - points.first);
        const auto [found, is_new] = foreign.emplace(point, static_cast<std::uint32_t>(used.size()));
        if (is_new) used.push_back(point);
        return found->second;
    };
    if (surface.polygons.all_triangles()) {
        result.polygons.corners.resize(3 * (polygons.last - polygons.first));
        for (std::size_t c = 0; c < result.polygons.corners.size(); ++c) {
            result.polygons.corners[c] = node_of(surface.polygons.corners[3 * polygons.first + c]);
        }
    } else {
        std::vector<std::uint32_t> polygon;
        for (std::size_t p = polygons.first; p < polygons.last; ++p) {
            polygon.clear();
            for (const std::uint32_t point : surface.polygons[p]) polygon.push_back(node_of(point));
            result.polygons.push_back(polygon);
        }
    }
    result.nodes.reserve(used.size());
    for (const std::uint32_t point : used) result.nodes.emplace_back(vertex_of[point]);
    std::vector<std::uint32_t> polygon_indices(polygons.last - polygons.first);
    std::iota(polygon_indices.begin(), polygon_indices.end(), static_cast<std::uint32_t>(polygons.first));
    add_attributes(surface, used, polygon_indices, result);
    return result;
}

SurfaceComplex::Face face_of_part(const Surface& surface, std::uint32_t object, std::uint32_t part, const WeldedPoints& points) {
    SurfaceComplex::Face face;
    face.surface = surface_of_part(surface, part, points.of.at(object));
    face.surface.source_object = object;
    face.surface.source_part = part;
    face.first_polygon = surface.parts.empty() ? 0 : surface.parts[part].first_polygon;
    face.tolerance = points.tolerance.at(object);
    return face;
}

SurfaceComplex::Face face_of_polygons(const Surface& surface, std::uint32_t object, const std::vector<std::uint32_t>& polygons,
                                      const WeldedPoints& points) {
    SurfaceComplex::Face face;
    std::vector<std::uint32_t> used, polygon;
    for (const std::uint32_t p : polygons) used.insert(used.end(), surface.polygons[p].begin(), surface.polygons[p].end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto& vertex_of = points.of.at(object);
    for (const std::uint32_t point : used) face.surface.nodes.emplace_back(vertex_of[point]);
    for (const std::uint32_t p : polygons) {
        polygon.clear();
        for (const std::uint32_t point : surface.polygons[p])
            polygon.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(used, point) - used.begin()));
        face.surface.polygons.push_back(polygon);
    }
    add_attributes(surface, used, polygons, face.surface);
    face.surface.source_object = object;
    face.source_polygons = polygons;
    face.tolerance = points.tolerance.at(object);
    return face;
}

void add_corner_hints(const Object& object, const std::vector<std::uint32_t>& vertex_of, SurfaceComplex& complex) {
    const auto* surface = std::get_if<Surface>(&object);
    if (surface == nullptr) return;
    for (const std::uint32_t point : surface->border_corners) {
        if (point < surface->points.size()) complex.lines.corner_hints.push_back(vertex_of[point]);
    }
}

}  // namespace geomend::topology
