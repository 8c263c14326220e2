// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/lay_borders.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "base/vectors.h"
#include "geometry/box_tree.h"
#include "geometry/closest_points.h"
#include "model/objects.h"
#include "repair/soup_edges.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

/// Where a vertex of a border may go: to a vertex rather than onto an edge, and rather there than onto a face.
struct Place {
    int corners = 4;  ///< of the part that has it: 1 a vertex, 2 an edge, 3 a face; 4: none
    double distance = 0;
    Vec3 point{};
    auto rank() const { return std::tuple(corners, distance, point); }
};

/// A vertex that an edge of a border gets.
struct Insertion {
    double along = 0;  ///< share of the edge
    std::uint32_t vertex = 0;
    auto operator<=>(const Insertion&) const = default;
};
using Edge = std::array<std::uint32_t, 2>;  ///< vertices, ascending
Edge edge_between(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

struct BorderOfTriangle {
    std::uint32_t triangle, corner;  ///< the edge runs from this corner to the next one
    std::vector<Insertion> points;
};

std::uint32_t number_of_patch(const TriangleSoup& soup, std::span<const SoupEdges::Use> uses, std::uint32_t patch) {
    return static_cast<std::uint32_t>(std::ranges::count_if(uses, [&](const auto& use) { return soup.patches[use.triangle] == patch; }));
}

/// Whether the corner of a triangle opposite an edge lies within the tolerance of it.
bool is_flat_on(const TriangleSoup& soup, const SoupEdges::Use& use, double tolerance) {
    const Vec3& apex = soup.vertices[soup.triangles[use.triangle][(use.corner + 2u) % 3]];
    const Vec3 base = soup.vertices[use.low], way = minus(soup.vertices[use.high], base), to_apex = minus(apex, base);
    const double along = dot(to_apex, way), square = dot(way, way);
    if (along <= 0 || along >= square) return false;
    const Vec3 off = across(to_apex, way);
    return dot(off, off) <= tolerance * tolerance;
}

/// Slivers at borders that are no higher than the tolerance: without them the border runs along their other edges. How many.
std::uint64_t drop_slivers(const TriangleSoup& soup, double tolerance, std::vector<std::uint8_t>& keep) {
    constexpr unsigned most_rounds = 4;  // of slivers behind slivers
    std::uint64_t dropped = 0;
    for (unsigned round = 0; round < most_rounds; ++round) {
        const std::uint64_t before = dropped;
        const SoupEdges edges = edges_of(soup, keep);
        for (std::size_t e = 0; e < edges.size(); ++e) {
            for (const auto& use : edges[e]) {
                if (keep[use.triangle] == 0 || number_of_patch(soup, edges[e], soup.patches[use.triangle]) != 1) continue;
                if (!is_flat_on(soup, use, tolerance)) continue;
                keep[use.triangle] = 0;
                ++dropped;
            }
        }
        if (dropped == before) break;
    }
    return dropped;
}

class BorderLayer {
public:
    BorderLayer(const TriangleSoup& soup, double tolerance)
        : soup_(soup),
          tolerance_(tolerance),
          tree_(triangle_boxes(soup)),
          patches_at_(soup.vertices.size()),
          is_at_border_(soup.vertices.size(), 0) {
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            for (const std::uint32_t v : soup.triangles[t]) {
                if (std::ranges::find(patches_at_[v], soup.patches[t]) == patches_at_[v].end()) patches_at_[v].push_back(soup.patches[t]);
            }
        }
    }

    LaidBorders run() {
        const SoupEdges edges = edges_of(soup_);
        const auto is_border = [&](std::span<const SoupEdges::Use> uses, const SoupEdges::Use& use) {
            return number_of_patch(soup_, uses, soup_.patches[use.triangle]) == 1;
        };
        for (std::size_t e = 0; e < edges.size(); ++e) {
            if (std::ranges::none_of(edges[e], [&](const auto& use) { return is_border(edges[e], use); })) continue;
            border_edges_.push_back({edges[e][0].low, edges[e][0].high});  // ascending, as they are there
            is_at_border_[edges[e][0].low] = is_at_border_[edges[e][0].high] = 1;
        }
        for (std::size_t e = 0; e < edges.size(); ++e) {
            for (const auto& use : edges[e]) {
                if (is_border(edges[e], use)) look_around(use);
            }
            if (edges[e].size() > 1) look_at_line(edges[e]);
        }
        LaidBorders laid;
        laid.soup = soup_;
        laid.origin = identity_origin(soup_);
        for (const MadeVertex& v : made_) {
            const auto& [a, b, c] = corners_of(v.triangle);
            laid.soup.vertices.push_back(v.place);
            laid.origin.vertices.push_back(Origin::from_triangle(v.triangle, weights_in(a, b, c, v.place)));
        }
        move_vertices(laid);
        std::ranges::stable_sort(borders_, {}, &BorderOfTriangle::triangle);
        for (const BorderOfTriangle& border : borders_) insert(border, laid);
        return laid;
    }

private:
    const TriangleSoup& soup_;
    double tolerance_;
    BoxTree tree_;
    std::vector<std::vector<std::uint32_t>> patches_at_;
    std::vector<Edge> border_edges_;          ///< ascending
    std::vector<std::uint8_t> is_at_border_;  ///< per vertex
    std::map<std::uint32_t, Place> places_;   ///< by vertex
    std::vector<BorderOfTriangle> borders_;
    struct MadeVertex {
        Vec3 place;
        std::uint32_t triangle;  ///< that it lies in
    };
    std::vector<MadeVertex> made_;                          ///< numbered after those of the soup
    std::map<std::array<Edge, 2>, std::uint32_t> made_of_;  ///< by the two edges that pass each other

    std::array<Vec3, 3> corners_of(std::uint32_t t) const {
        const auto& [a, b, c] = soup_.triangles[t];
        return {soup_.vertices[a], soup_.vertices[b], soup_.vertices[c]};
    }
    bool is_border_edge(const Edge& edge) const { return std::ranges::binary_search(border_edges_, edge); }
    bool ends_on(std::uint32_t vertex, std::uint32_t patch) const {
        return std::ranges::find(patches_at_[vertex], patch) != patches_at_[vertex].end();
    }

    void look_around(const SoupEdges::Use& use) {
        const Triangle& own = soup_.triangles[use.triangle];
        const std::uint32_t from = own[use.corner], to = own[(use.corner + 1) % 3];
        const std::array edge{soup_.vertices[from], soup_.vertices[to]};
        BorderOfTriangle border{use.triangle, use.corner, {}};
        BoxTree::Corners box;
        for (std::size_t k = 0; k < 3; ++k) {
            box[0][k] = std::min(edge[0][k], edge[1][k]) - tolerance_;
            box[1][k] = std::max(edge[0][k], edge[1][k]) + tolerance_;
        }
        tree_.visit(box, -1e-9 * tolerance_, [&](std::uint32_t t) {
            const Triangle& other = soup_.triangles[t];
            const auto is_shared = [&](std::uint32_t v) { return v == own[0] || v == own[1] || v == own[2]; };
            if (t == use.triangle || closest_points(edge, corners_of(t)).distance > tolerance_) return;
            const bool same = soup_.patches[t] == soup_.patches[use.triangle], beside = std::ranges::any_of(other, is_shared);
            for (const std::uint32_t end : {from, to}) {
                if (same ? !beside : !ends_on(end, soup_.patches[t])) offer(end, t);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                if (is_shared(other[k])) continue;
                offer(edge, other[k], border);
                if (!is_shared(other[(k + 1) % 3])) pass({from, to}, edge_between(other[k], other[(k + 1) % 3]), border);
            }
        });
        if (border.points.empty()) return;
        std::ranges::sort(border.points);
        borders_.push_back(std::move(border));
    }

    /// Triangles of two patches that lie on each other from their common edge on.
    void look_at_line(std::span<const SoupEdges::Use> uses) {
        for (const auto& a : uses) {
            const std::uint32_t lone = soup_.triangles[a.triangle][(a.corner + 2u) % 3];
            for (const auto& b : uses) {
                const Triangle& other = soup_.triangles[b.triangle];
                if (soup_.patches[a.triangle] == soup_.patches[b.triangle] || std::ranges::find(other, lone) != other.end()) continue;
                const auto corners = corners_of(b.triangle);
                const Closest there = closest_points(soup_.vertices[lone], corners);
                const Vec3 &low = soup_.vertices[a.low], &high = soup_.vertices[a.high];
                const bool beside = closest_points(soup_.vertices[lone], {low, high, high}).distance > there.distance;
                if (there.distance <= tolerance_ && beside) offer(lone, b.triangle);
            }
        }
    }

    /// A vertex of a border beside a triangle: to its corner, onto its edge or into it. Of two vertices of borders the later one goes
    /// to the first; where an edge is a border it comes to the vertex, and this stays.
    void offer(std::uint32_t vertex, std::uint32_t t) {
        const Vec3& own = soup_.vertices[vertex];
        const Triangle& other = soup_.triangles[t];
        const auto corners = corners_of(t);
        Place best;
        const auto consider = [&](const Place& place) {
            if (place.distance <= tolerance_ && place.rank() < best.rank()) best = place;
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = corners[k], &b = corners[(k + 1) % 3];
            const bool goes = is_at_border_[other[k]] == 0 || other[k] < vertex;
            consider({1, length_of(minus(a, own)), goes ? a : own});
            const Closest on_edge = closest_points(own, {a, b, b});
            consider({2, on_edge.distance, is_border_edge(edge_between(other[k], other[(k + 1) % 3])) ? own : on_edge.on_second});
        }
        const Closest inside = closest_points(own, corners);
        if (std::popcount(inside.second_part) == 3) consider({3, inside.distance, inside.on_second});
        if (best.corners > 3) return;
        auto [known, added] = places_.try_emplace(vertex, best);
        if (!added && best.rank() < known->second.rank()) known->second = best;
    }

    static double length_of(const Vec3& v) { return std::sqrt(dot(v, v)); }

    /// A vertex of another surface beside an edge of a border.
    void offer(const std::array<Vec3, 2>& edge, std::uint32_t vertex, BorderOfTriangle& border) const {
        const Vec3 way = minus(edge[1], edge[0]), to_vertex = minus(soup_.vertices[vertex], edge[0]);
        const double length = length_of(way), along = dot(to_vertex, way) / length;
        if (along < tolerance_ || along > length - tolerance_) return;
        if (length_of(across(to_vertex, way)) <= tolerance_) border.points.push_back({along / length, vertex});
    }

    /// An edge of another surface that an edge of a border passes: the vertex for both lies on the other one, or, where that is a
    /// border, too, on the first of them.
    void pass(const Edge& own, const Edge& other, BorderOfTriangle& border) {
        const Edge one = edge_between(own[0], own[1]);
        const bool on_one = is_border_edge(other) && one < other;
        const Vec3 &a = soup_.vertices[own[0]], &b = soup_.vertices[own[1]], &p = soup_.vertices[other[0]], &q = soup_.vertices[other[1]];
        const Vec3 u = minus(b, a), v = minus(q, p), w = minus(a, p);
        const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w), square = uu * vv - uv * uv;
        if (square <= 1e-9 * uu * vv) return;  // side by side: their ends tell
        const double s = (uv * vw - vv * uw) / square, t = (uu * vw - uv * uw) / square;
        const double end_s = tolerance_ / std::sqrt(uu), end_t = tolerance_ / std::sqrt(vv);
        if (s < end_s || s > 1 - end_s || t < end_t || t > 1 - end_t) return;
        const Vec3 here = plus(a, times(s, u)), there = plus(p, times(t, v));
        if (length_of(minus(here, there)) > tolerance_) return;
        const auto next = static_cast<std::uint32_t>(soup_.vertices.size() + made_.size());
        const auto [made, is_new] = made_of_.try_emplace(one < other ? std::array{one, other} : std::array{other, one}, next);
        if (is_new) made_.push_back({on_one ? here : there, border.triangle});
        border.points.push_back({s, made->second});
    }

    bool is_thin(std::uint32_t t) const {
        constexpr double thin = 4;  // tolerances
        const auto corners = corners_of(t);
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, length_of(minus(corners[(k + 1) % 3], corners[k])));
        return 2 * triangle_area(soup_, t) <= thin * tolerance_ * longest;
    }

    void move_vertices(LaidBorders& laid) {
        std::vector<std::vector<std::uint32_t>> around(soup_.vertices.size());
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            for (const std::uint32_t v : soup_.triangles[t]) {
                if (places_.contains(v)) around[v].push_back(t);
            }
        }
        for (const auto& [vertex, place] : places_) {
            const Vec3 was = laid.soup.vertices[vertex];
            if (place.point == was) continue;
            laid.soup.vertices[vertex] = place.point;
            const bool turns = std::ranges::any_of(around[vertex], [&](std::uint32_t t) {
                if (is_thin(t)) return false;  // it becomes a part of what it lies on
                const Vec3 before = triangle_normal(soup_, t), after = triangle_normal(laid.soup, t);
                return dot(before, after) <= 0.5 * std::sqrt(dot(before, before) * dot(after, after));
            });
            if (turns) laid.soup.vertices[vertex] = was;
            else ++laid.moved;
        }
    }

    /// Puts the vertices of one edge into the piece of its triangle that still has it.
    void insert(const BorderOfTriangle& border, LaidBorders& laid) const {
        const Triangle& own = soup_.triangles[border.triangle];
        const std::uint32_t to = own[(border.corner + 1) % 3];
        std::uint32_t from = own[border.corner];
        for (const auto& [along, vertex] : border.points) {
            if (length_of(minus(laid.soup.vertices[vertex], laid.soup.vertices[from])) < tolerance_) continue;
            const std::uint32_t piece = piece_with(border.triangle, from, to, laid);
            if (piece == no_index) return;
            Triangle& old = laid.soup.triangles[piece];
            if (std::ranges::find(old, vertex) != old.end()) continue;
            const auto k = static_cast<std::size_t>(std::ranges::find(old, from) - old.begin());
            const std::uint32_t apex = old[(k + 2) % 3];
            old = {from, vertex, apex};
            laid.soup.triangles.push_back({vertex, to, apex});
            laid.soup.patches.push_back(soup_.patches[border.triangle]);
            laid.origin.triangles.push_back(border.triangle);
            ++laid.made;
            from = vertex;
        }
    }

    std::uint32_t piece_with(std::uint32_t triangle, std::uint32_t from, std::uint32_t to, const LaidBorders& laid) const {
        const auto has = [&](std::uint32_t t) {
            const Triangle& p = laid.soup.triangles[t];
            for (std::size_t k = 0; k < 3; ++k) {
                if (p[k] == from && p[(k + 1) % 3] == to) return true;
            }
            return false;
        };
        if (has(triangle)) return triangle;
        for (auto t = static_cast<std::uint32_t>(laid.soup.triangles.size()); t-- > soup_.triangles.size();) {
            if (laid.origin.triangles[t] != triangle) break;  // pieces of one triangle come one after the other
            if (has(t)) return t;
        }
        return no_index;
    }
};

}  // namespace

LaidBorders lay_borders(const TriangleSoup& soup, double tolerance) {
    std::vector<std::uint8_t> keep(soup.triangles.size(), 1);
    const std::uint64_t dropped = drop_slivers(soup, tolerance, keep);
    if (dropped == 0) return BorderLayer(soup, tolerance).run();
    TriangleSoup rest = soup;
    rest.triangles.clear();
    rest.patches.clear();
    std::vector<std::uint32_t> number;
    for (std::uint32_t t = 0; t < keep.size(); ++t) {
        if (keep[t] == 0) continue;
        number.push_back(t);
        rest.triangles.push_back(soup.triangles[t]);
        rest.patches.push_back(soup.patches[t]);
    }
    LaidBorders laid = BorderLayer(rest, tolerance).run();
    for (std::uint32_t& t : laid.origin.triangles) t = number[t];
    for (auto& v : laid.origin.vertices) {
        if (v.triangle != no_index) v.triangle = number[v.triangle];
    }
    laid.dropped = dropped;
    return laid;
}

}  // namespace geomend::repair
