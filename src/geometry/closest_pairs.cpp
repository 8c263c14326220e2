// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "geometry/near_misses.h"
#include "geometry/surface_distance.h"
#include "geometry/triangle_pair.h"

namespace geomend {

namespace {

constexpr std::size_t vertices_per_chunk = 1024;
constexpr int tries_per_pair = 16;  // descents that end in a smallest distance, for each two groups

/// A vertex that is near a group it is not on, and the closest triangle of that group.
struct NearVertex {
    std::uint32_t vertex, group, triangle;
    Closest closest;
};

/// A place where two surfaces are close, on the way to where they are closest.
struct Place {
    std::uint32_t triangle_a, triangle_b;
    Closest closest;
};

class PairSearch {
public:
    PairSearch(const SurfaceDistance& soup, double near) : soup_(soup), near_(near) {}

    bool find_near_vertices(std::size_t vertices, const Monitor* monitor) {
        std::vector<std::vector<NearVertex>> parts((vertices + vertices_per_chunk - 1) / vertices_per_chunk);
        parallel_for_each_index(parts.size(), [&](std::size_t part) {
            if (monitor != nullptr && monitor->stopped()) return;
            const std::size_t last = std::min(vertices, (part + 1) * vertices_per_chunk);
            for (std::size_t v = part * vertices_per_chunk; v < last; ++v) add_near(static_cast<std::uint32_t>(v), parts[part]);
        });
        for (const auto& part : parts) near_vertices_.insert(near_vertices_.end(), part.begin(), part.end());
        return monitor == nullptr || !monitor->stopped();
    }

    std::vector<ClosePair> pairs() {
        for (const Start& start : starts()) {
            const std::pair key = std::minmax(start.group, start.from->group);
            Best& best = best_[key];
            if (best.tries == tries_per_pair) continue;
            const auto found = descend(start);
            if (!found) continue;
            ++best.tries;
            if (best.tries == 1 || found->distance < best.pair.distance) best.pair = *found;
        }
        std::vector<ClosePair> all;
        for (const auto& [key, best] : best_) {
            if (best.tries > 0) all.push_back(best.pair);
        }
        return all;
    }

private:
    /// A vertex that is closer to the group of `from` than its neighbours on its own group are.
    struct Start {
        std::uint32_t group;
        const NearVertex* from;
    };
    struct Best {
        int tries = 0;
        ClosePair pair{};
    };

    const SurfaceDistance& soup_;
    const double near_;
    std::vector<NearVertex> near_vertices_;  ///< by vertex, then by group
    std::map<std::pair<std::uint32_t, std::uint32_t>, Best> best_;

    void add_near(std::uint32_t vertex, std::vector<NearVertex>& list) const {
        if (soup_.around(vertex).empty()) return;
        const Vec3& point = soup_.position(vertex);
        const std::uint32_t own = soup_.group(soup_.around(vertex).front());
        const std::size_t first = list.size();
        soup_.tree().visit_triangles(soup_.tree().box(point, point, near_), [&](std::size_t i) {
            const std::uint32_t t = soup_.tree().number(i), group = soup_.group(t);
            if (group == own || soup_.on_group(vertex, group)) return;
            const Closest closest = closest_points(point, soup_.corners(t));
            if (closest.distance >= near_) return;
            const auto known = std::find_if(list.begin() + first, list.end(), [&](const NearVertex& n) { return n.group == group; });
            if (known == list.end()) list.push_back({vertex, group, t, closest});
            else if (closest.distance < known->closest.distance) *known = {vertex, group, t, closest};
        });
        std::sort(list.begin() + first, list.end(), [](const NearVertex& p, const NearVertex& q) { return p.group < q.group; });
    }

    /// Distance of a vertex from a group: 0 on it, HUGE_VAL where it is not near.
    double distance(std::uint32_t vertex, std::uint32_t group) const {
        if (soup_.on_group(vertex, group)) return 0;
        const auto at = std::lower_bound(near_vertices_.begin(), near_vertices_.end(), std::pair{vertex, group},
                                         [](const NearVertex& n, const auto& key) {
                                             return std::pair{n.vertex, n.group} < key;
                                         });
        return at != near_vertices_.end() && at->vertex == vertex && at->group == group ? at->closest.distance : HUGE_VAL;
    }

    bool neighbours_are_farther(const NearVertex& from, std::uint32_t own) const {
        for (const std::uint32_t t : soup_.around(from.vertex)) {
            if (soup_.group(t) != own) continue;
            for (const std::uint32_t v : soup_.triangle(t)) {
                if (v != from.vertex && distance(v, from.group) < from.closest.distance) return false;
            }
        }
        return true;
    }

    /// The closest first.
    std::vector<Start> starts() const {
        std::vector<std::vector<Start>> parts((near_vertices_.size() + vertices_per_chunk - 1) / vertices_per_chunk);
        parallel_for_each_index(parts.size(), [&](std::size_t part) {
            const std::size_t last = std::min(near_vertices_.size(), (part + 1) * vertices_per_chunk);
            for (std::size_t i = part * vertices_per_chunk; i < last; ++i) {
                const NearVertex& from = near_vertices_[i];
                if (from.closest.distance == 0) continue;
                for (const std::uint32_t own : soup_.groups_at(from.vertex)) {
                    if (neighbours_are_farther(from, own)) parts[part].push_back({own, &from});
                }
            }
        });
        std::vector<Start> all;
        for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
        std::stable_sort(all.begin(), all.end(),
                         [](const Start& p, const Start& q) { return p.from->closest.distance < q.from->closest.distance; });
        return all;
    }

    /// Moves both points over their surfaces for as long as they come closer. Nothing where they meet or where the place does not count.
    std::optional<ClosePair> descend(const Start& start) const {
        const NearVertex& from = *start.from;
        const auto around = soup_.around_edge(from.vertex, from.vertex, start.group);
        if (around.empty()) return std::nullopt;
        const std::uint32_t t = around.front();
        Place place{t, from.triangle, from.closest};
        for (unsigned i = 0; i < 3; ++i) {
            if (soup_.triangle(t)[i] == from.vertex) place.closest.first_part = 1u << i;
        }
        while (true) {
            const auto next = closest_around(place, start.group, from.group);
            if (!next) return std::nullopt;
            if (next->closest.distance >= place.closest.distance - soup_.rounding(place.closest.on_first)) break;
            place = *next;
        }
        if (lie_on_one_group(place)) return std::nullopt;
        if (soup_.common_vertex_within(2 * near_, place.closest.on_first, start.group, from.group)) return std::nullopt;
        const Closest& c = place.closest;
        if (start.group < from.group)
            return ClosePair{start.group, from.group, place.triangle_a, place.triangle_b, c.distance, c.on_first, c.on_second};
        return ClosePair{from.group, start.group, place.triangle_b, place.triangle_a, c.distance, c.on_second, c.on_first};
    }

    /// The closest of the triangles around both points; nothing where any of them meet.
    std::optional<Place> closest_around(const Place& place, std::uint32_t group_a, std::uint32_t group_b) const {
        Place best = place;
        best.closest.distance = HUGE_VAL;
        for (const std::uint32_t a : soup_.around_part(place.triangle_a, place.closest.first_part, group_a)) {
            for (const std::uint32_t b : soup_.around_part(place.triangle_b, place.closest.second_part, group_b)) {
                if (share_a_vertex(a, b) || meeting(soup_.positions(), soup_.triangle(a), soup_.triangle(b)).kind != Meeting::none)
                    return std::nullopt;
                const Closest closest = closest_points(soup_.corners(a), soup_.corners(b));
                if (closest.distance < best.closest.distance) best = {a, b, closest};
            }
        }
        return best;
    }

    bool share_a_vertex(std::uint32_t a, std::uint32_t b) const {
        const Triangle &p = soup_.triangle(a), &q = soup_.triangle(b);
        return std::find_first_of(p.begin(), p.end(), q.begin(), q.end()) != p.end();
    }

    bool lie_on_one_group(const Place& place) const {
        const auto a = soup_.groups_around_part(place.triangle_a, place.closest.first_part);
        const auto b = soup_.groups_around_part(place.triangle_b, place.closest.second_part);
        return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
    }
};

}  // namespace

std::vector<ClosePair> closest_pairs(const TriangleTree& tree, std::span<const Triangle> triangles, std::span<const std::uint32_t> groups,
                                     double near, const Monitor* monitor) {
    if (tree.size() == 0 || !(near > 0)) return {};
    const SurfaceDistance soup(tree, triangles, groups);
    PairSearch search(soup, near);
    if (!search.find_near_vertices(tree.vertices().size(), monitor)) return {};
    return search.pairs();
}

}  // namespace geomend
