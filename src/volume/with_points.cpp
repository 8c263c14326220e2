// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <utility>

#include "base/vectors.h"
#include "model/attribute_operations.h"
#include "model/origin.h"
#include "volume/surface_points.h"

namespace geomend::volumes {

namespace {

using Ends = std::array<std::uint32_t, 2>;

Ends ends_of(std::uint32_t a, std::uint32_t b) { return a < b ? Ends{a, b} : Ends{b, a}; }

/// New vertices on edges, one for each at a time.
using EdgeVertices = std::map<Ends, std::uint32_t>;

/// Divides the triangles of one surface.
class SurfaceSplitter {
public:
    SurfaceSplitter(const std::vector<Vec3>& vertices, BrepData::Surface& surface)
        : vertices_(vertices), surface_(surface), old_corners_(surface.polygons.corners) {
        for (std::uint32_t n = 0; n < surface.nodes.size(); ++n) samples_.push_back({{n, n, n}, {1, 0, 0}});
        for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) origin_.push_back(p);
    }

    /// A vertex inside of the triangle that was there with these corners.
    void put_inside(const Triangle& corners, std::uint32_t vertex) {
        std::uint32_t best = no_index;
        double most = -1;
        for (std::uint32_t p = 0; p < origin_.size(); ++p) {
            if (!came_from(p, corners)) continue;
            const Weights w = weights_in(place(p, 0), place(p, 1), place(p, 2), vertices_[vertex]);
            const double least = *std::ranges::min_element(w);
            if (least > most) {
                most = least;
                best = p;
            }
        }
        if (best != no_index) split_face(best, add_node(best, vertex));
    }

    void put_on_edges(const EdgeVertices& made) {
        if (made.empty()) return;
        std::map<Ends, std::vector<std::uint32_t>> polygons;  // that have such an edge
        for (std::uint32_t p = 0; p < origin_.size(); ++p) {
            for (unsigned k = 0; k < 3; ++k) {
                if (made.contains(ends(p, k))) polygons[ends(p, k)].push_back(p);
            }
        }
        for (auto& [edge, of] : polygons) {
            const std::uint32_t vertex = made.at(edge);
            while (!of.empty()) {
                const std::uint32_t p = of.back();
                of.pop_back();
                const std::uint32_t across = surface_.neighbours[3 * p + corner_of(p, edge)], node = add_node(p, vertex);
                const std::uint32_t rest = split_half(p, edge, node, polygons);
                if (across == no_index) continue;
                std::erase(of, across);
                const std::uint32_t rest_across = split_half(across, edge, node, polygons);
                link(p, rest_across);
                link(rest, across);
            }
        }
    }

    void finish() {
        for (Attribute& a : surface_.attributes) {
            if (a.location == AttributeLocation::point) a = interpolated(a, samples_);
            else if (a.location == AttributeLocation::polygon) a = taken(a, origin_);
        }
    }

private:
    const std::vector<Vec3>& vertices_;
    BrepData::Surface& surface_;
    const std::vector<std::uint32_t> old_corners_;
    std::vector<Sample> samples_;        ///< per node, of those that were there
    std::vector<std::uint32_t> origin_;  ///< per polygon the one that it is a part of

    std::uint32_t& corner(std::uint32_t p, unsigned k) { return surface_.polygons.corners[3 * std::size_t{p} + k]; }
    std::uint32_t vertex_at(std::uint32_t p, unsigned k) { return surface_.nodes[corner(p, k)].value; }
    const Vec3& place(std::uint32_t p, unsigned k) { return vertices_[vertex_at(p, k)]; }
    Ends ends(std::uint32_t p, unsigned k) { return ends_of(vertex_at(p, k), vertex_at(p, (k + 1) % 3)); }
    unsigned corner_of(std::uint32_t p, const Ends& edge) {
        unsigned k = 0;
        while (k < 2 && ends(p, k) != edge) ++k;
        return k;
    }
    bool came_from(std::uint32_t p, const Triangle& corners) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (surface_.nodes[old_corners_[3 * std::size_t{origin_[p]} + k]].value != corners[k]) return false;
        }
        return true;
    }

    std::uint32_t add_node(std::uint32_t p, std::uint32_t vertex) {
        const std::size_t first = 3 * std::size_t{origin_[p]};
        const std::array<std::uint32_t, 3> rows{old_corners_[first], old_corners_[first + 1], old_corners_[first + 2]};
        const auto at = [&](std::size_t k) { return vertices_[surface_.nodes[rows[k]].value]; };
        samples_.push_back({rows, weights_in(at(0), at(1), at(2), vertices_[vertex])});
        surface_.nodes.push_back(VertexId(vertex));
        return static_cast<std::uint32_t>(surface_.nodes.size()) - 1;
    }

    std::uint32_t add_polygon(std::uint32_t part_of, const Triangle& corners, const std::array<std::uint32_t, 3>& neighbours) {
        surface_.polygons.corners.insert(surface_.polygons.corners.end(), corners.begin(), corners.end());
        surface_.neighbours.insert(surface_.neighbours.end(), neighbours.begin(), neighbours.end());
        origin_.push_back(origin_[part_of]);
        return static_cast<std::uint32_t>(origin_.size()) - 1;
    }

    /// What lay across an edge of `before` lies across the one of `now` that is the same.
    void renew(std::uint32_t neighbour, std::uint32_t before, std::uint32_t now, const Ends& edge) {
        if (neighbour == no_index) return;
        for (unsigned k = 0; k < 3; ++k) {
            std::uint32_t& across = surface_.neighbours[3 * std::size_t{neighbour} + k];
            if (across == before && ends(neighbour, k) == edge) across = now;
        }
    }

    /// The halves beside one half of an edge: each has it first.
    void link(std::uint32_t p, std::uint32_t q) {
        surface_.neighbours[3 * std::size_t{p}] = q;
        surface_.neighbours[3 * std::size_t{q}] = p;
    }

    /// The triangle keeps what lies before the node on its edge, as its first edge; the rest is a new one.
    std::uint32_t split_half(std::uint32_t p, const Ends& edge, std::uint32_t node, std::map<Ends, std::vector<std::uint32_t>>& polygons) {
        const unsigned k = corner_of(p, edge);
        const std::uint32_t a = corner(p, k), b = corner(p, (k + 1) % 3), c = corner(p, (k + 2) % 3);
        const std::size_t first = 3 * std::size_t{p};
        const std::uint32_t beyond_b = surface_.neighbours[first + (k + 1) % 3], beyond_a = surface_.neighbours[first + (k + 2) % 3];
        const Ends moved = ends(p, (k + 1) % 3);
        const std::uint32_t rest = add_polygon(p, {node, b, c}, {no_index, beyond_b, p});
        renew(beyond_b, p, rest, moved);
        if (const auto waiting = polygons.find(moved); waiting != polygons.end()) std::ranges::replace(waiting->second, p, rest);
        corner(p, 0) = a, corner(p, 1) = node, corner(p, 2) = c;
        surface_.neighbours[first] = no_index;
        surface_.neighbours[first + 1] = rest;
        surface_.neighbours[first + 2] = beyond_a;
        return rest;
    }

    void split_face(std::uint32_t p, std::uint32_t node) {
        const std::uint32_t a = corner(p, 0), b = corner(p, 1), c = corner(p, 2);
        const std::size_t first = 3 * std::size_t{p};
        const std::uint32_t beyond_b = surface_.neighbours[first + 1], beyond_c = surface_.neighbours[first + 2];
        const Ends bc = ends(p, 1), ca = ends(p, 2);
        const auto q = static_cast<std::uint32_t>(origin_.size());
        add_polygon(p, {b, c, node}, {beyond_b, q + 1, p});
        add_polygon(p, {c, a, node}, {beyond_c, p, q});
        renew(beyond_b, p, q, bc);
        renew(beyond_c, p, q + 1, ca);
        corner(p, 2) = node;
        surface_.neighbours[first + 1] = q;
        surface_.neighbours[first + 2] = q + 1;
    }
};

/// Lines get the vertices on their edges.
void put_on_lines(const EdgeVertices& made, BrepData& brep) {
    for (auto& line : brep.lines) {
        std::vector<VertexId> vertices;
        for (const VertexId v : line.vertices) {
            if (!vertices.empty()) {
                const auto found = made.find(ends_of(vertices.back().value, v.value));
                if (found != made.end()) vertices.emplace_back(found->second);
            }
            vertices.push_back(v);
        }
        line.vertices = std::move(vertices);
    }
}

/// The points of each edge, from its first end on.
std::map<Ends, std::vector<Vec3>> by_edge(const BrepData& brep, const std::vector<SurfacePoints::OnEdge>& points) {
    std::map<Ends, std::vector<Vec3>> all;
    for (const auto& point : points) all[point.ends].push_back(point.place);
    for (auto& [edge, places] : all) {
        const Vec3& from = brep.vertices[edge[0]];
        const auto way = [&](const Vec3& p) {
            const Vec3 d = minus(p, from);
            return dot(d, d);
        };
        std::ranges::sort(places, {}, way);
        const auto repeats = std::ranges::unique(places);
        places.erase(repeats.begin(), repeats.end());
    }
    return all;
}

}  // namespace

BrepData with_points(const BrepData& brep, const SurfacePoints& points) {
    BrepData made = brep;
    const auto add_vertex = [&](const Vec3& place) {
        made.vertices.push_back(place);
        return static_cast<std::uint32_t>(made.vertices.size()) - 1;
    };
    std::vector<SurfaceSplitter> splitters;
    splitters.reserve(made.surfaces.size());
    for (auto& surface : made.surfaces) splitters.emplace_back(made.vertices, surface);
    for (const auto& point : points.inside) splitters[point.surface].put_inside(point.corners, add_vertex(point.place));
    // The edge from the last point of an edge on has the next one.
    std::map<Ends, std::pair<Ends, std::size_t>> waiting;  // edge as it is now: edge as it was, and the number of its next point
    const auto places = by_edge(brep, points.on_edges);
    for (const auto& [edge, of] : places) waiting[edge] = {edge, 0};
    while (!waiting.empty()) {
        EdgeVertices vertices;
        std::map<Ends, std::pair<Ends, std::size_t>> next;
        for (const auto& [edge, which] : waiting) {
            const auto& [was, number] = which;
            const std::uint32_t v = add_vertex(places.at(was)[number]);
            vertices[edge] = v;
            if (number + 1 < places.at(was).size()) next[{was[1], v}] = {was, number + 1};
        }
        for (SurfaceSplitter& splitter : splitters) splitter.put_on_edges(vertices);
        put_on_lines(vertices, made);
        waiting = std::move(next);
    }
    for (SurfaceSplitter& splitter : splitters) splitter.finish();
    return made;
}

}  // namespace geomend::volumes
