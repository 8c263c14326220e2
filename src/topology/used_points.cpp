// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/used_points.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "topology/weld.h"

namespace geomend::topology {

namespace {

/// Adds the elements of one object after the other.
class Collector {
public:
    Collector(std::size_t points, UsedPoints& to) : welder_(points), to_(to) {}

    void begin(const std::vector<Vec3>& points) {
        points_ = &points;
        vertex_of_.assign(points.size(), no_index);
        to_.first_triangle.push_back(count());
        to_.volumes.emplace_back();
    }
    /// A polygon as the fan of its first corner.
    void fan(std::span<const std::uint32_t> polygon) {
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) add(polygon[0], polygon[i], polygon[i + 1]);
    }
    /// A cell as triangles that link its nodes.
    void links(std::span<const std::uint32_t> nodes) {
        for (std::size_t i = 0; i + 2 < nodes.size(); i += 2) add(nodes[i], nodes[i + 1], nodes[i + 2]);
        if (nodes.size() % 2 == 0 && nodes.size() > 2) add(nodes[nodes.size() - 3], nodes[nodes.size() - 2], nodes.back());
    }
    /// A cell as a ring of triangles, whose middles have the middle of the nodes as theirs; each has a share of the volume.
    void ring(std::span<const std::uint32_t> nodes) {
        double volume6 = 0;
        for (std::size_t i = 1; i + 2 < nodes.size(); ++i) {
            const Vec3& o = (*points_)[nodes[0]];
            const auto way = [&](std::size_t k) { return minus((*points_)[nodes[k]], o); };
            volume6 += std::abs(dot(way(i), cross(way(i + 1), way(i + 2))));
        }
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            add(nodes[i], nodes[(i + 1) % nodes.size()], nodes[(i + 2) % nodes.size()]);
            to_.volumes.back().push_back(volume6 / static_cast<double>(nodes.size()));
        }
    }
    void weighted_end() { to_.first_unweighted.push_back(count()); }
    void end() {
        to_.first_triangle.push_back(count());
        to_.positions = welder_.take_positions();
    }

private:
    std::uint32_t count() const { return static_cast<std::uint32_t>(to_.triangles.size()); }
    std::uint32_t vertex(std::uint32_t point) {
        std::uint32_t& v = vertex_of_[point];
        if (v == no_index) v = welder_.add((*points_)[point]);
        return v;
    }
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::uint32_t u = vertex(a), v = vertex(b), w = vertex(c);
        to_.triangles.push_back({u, v, w});
        to_.object.push_back(static_cast<std::uint32_t>(to_.first_triangle.size() - 1));
    }

    Welder welder_;
    UsedPoints& to_;
    const std::vector<Vec3>* points_ = nullptr;
    std::vector<std::uint32_t> vertex_of_;
};

void add_mesh(const CellMesh& mesh, Collector& collector) {
    const auto nodes = [&](std::size_t c) {
        return std::span(mesh.nodes).subspan(mesh.offsets[c], static_cast<std::size_t>(mesh.offsets[c + 1] - mesh.offsets[c]));
    };
    const bool flat = std::ranges::any_of(mesh.types, [](CellType type) { return dimension(type) == 2; });
    for (std::size_t c = 0; c < mesh.types.size(); ++c) {
        const int d = dimension(mesh.types[c]);
        if (d == 2) collector.fan(nodes(c));
        else if (d == 3 && !flat) collector.ring(nodes(c));
    }
    collector.weighted_end();
    for (std::size_t c = 0; flat && c < mesh.types.size(); ++c) {
        if (dimension(mesh.types[c]) == 3) collector.links(nodes(c));
    }
}

/// The weight of each triangle, once for all who ask.
void weigh(UsedPoints& used) {
    used.weights.assign(used.triangles.size(), 0);
    for (std::size_t o = 0; o < used.first_unweighted.size(); ++o) {
        const std::vector<double>& volumes = used.volumes[o];
        const std::uint32_t first = used.first_triangle[o];
        for (std::uint32_t t = first; t < used.first_unweighted[o]; ++t) {
            const auto [a, b, c] = used.corners(t);
            const Vec3 n = cross(minus(b, a), minus(c, a));
            used.weights[t] = volumes.empty() ? 0.5 * std::sqrt(dot(n, n)) : volumes[t - first];
        }
    }
}

}  // namespace

UsedPoints used_points(const Dataset& dataset) {
    UsedPoints used;
    std::size_t points = 0, triangles = 0;
    for (const Object& object : dataset.objects) {
        if (const auto* surface = std::get_if<Surface>(&object)) {
            points += surface->points.size();
            triangles += surface->polygons.size();
        } else if (const auto* mesh = std::get_if<CellMesh>(&object)) {
            points += mesh->points.size();
        }
    }
    used.triangles.reserve(triangles);
    used.object.reserve(triangles);
    Collector collector(points, used);
    static const std::vector<Vec3> none;
    for (const Object& object : dataset.objects) {
        const auto* mesh = std::get_if<CellMesh>(&object);
        const auto* surface = std::get_if<Surface>(&object);
        collector.begin(mesh != nullptr ? mesh->points : surface != nullptr ? surface->points : none);
        if (mesh != nullptr) {
            add_mesh(*mesh, collector);
            continue;
        }
        for (std::size_t p = 0; surface != nullptr && p < surface->polygons.size(); ++p) collector.fan(surface->polygons[p]);
        collector.weighted_end();
    }
    collector.end();
    weigh(used);
    return used;
}

HangingParts hanging_parts(const UsedPoints& used) {
    DisjointSets sets(used.positions.size());
    for (const auto& t : used.triangles) {
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
    }
    HangingParts parts;
    parts.of_vertex = std::move(sets).roots();
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < parts.of_vertex.size(); ++v) {  // roots come first
        const std::uint32_t root = parts.of_vertex[v];
        parts.of_vertex[v] = root == v ? count++ : parts.of_vertex[root];
    }
    parts.first.assign(count + 1, 0);
    for (const auto& t : used.triangles) ++parts.first[parts.of_vertex[t[0]] + 1];
    for (std::uint32_t p = 0; p < count; ++p) parts.first[p + 1] += parts.first[p];
    parts.triangles.resize(used.triangles.size());
    std::vector<std::uint32_t> next(parts.first.begin(), parts.first.end() - 1);
    for (std::uint32_t t = 0; t < used.triangles.size(); ++t) parts.triangles[next[parts.of_vertex[used.triangles[t][0]]]++] = t;
    return parts;
}

}  // namespace geomend::topology
