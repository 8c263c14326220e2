// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "geometry/near_misses.h"
#include "geometry/surface_distance.h"
#include "geometry/triangle_pair.h"

namespace geomend {

namespace {

constexpr std::size_t fours_per_block = 4;    // the triangles whose vertices look about together
constexpr std::size_t blocks_per_chunk = 64;  // what one thread does at a time
constexpr int tries_per_pair = 16;            // descents that end in a smallest distance, for each two groups
constexpr std::uint32_t mixed = 0xffffffff;   // four triangles of more than one group

/// The triangle of another group (by its place in the tree) that is closest to a vertex.
struct NearGroup {
    std::uint32_t group, triangle;
    Closest closest;
};

/// A vertex that is closer to another group than its neighbours on its own group are.
struct Start {
    std::uint32_t group, vertex;
    NearGroup other;
};

/// A place where two surfaces are close, on the way to where they are closest.
struct Place {
    std::uint32_t triangle_a, triangle_b;
    Closest closest;
};

/// Finds starts among the vertices of some triangles.
class StartSearch {
public:
    StartSearch(const SurfaceDistance& soup, std::span<const std::uint32_t> four_groups, double near, std::vector<Start>& starts)
        : soup_(soup), four_groups_(four_groups), near_(near), around_(soup.tree()), starts_(starts) {}

    void run(std::size_t block) {
        const auto& fours = soup_.tree().levels().front();
        const std::size_t first = block * fours_per_block, last = std::min(fours.size(), first + fours_per_block);
        std::uint32_t own = four_groups_[first];
        for (std::size_t four = first; four != last; ++four) own = four_groups_[four] == own ? own : mixed;
        around_.collect(soup_.tree().widened(outer_box(fours, first, last), near_),
                        [&](std::size_t four) { return own == mixed || four_groups_[four] != own; });
        if (around_.empty()) return;
        for (std::size_t i = 4 * first; i < std::min(4 * last, soup_.tree().size()); ++i) {
            for (const std::uint32_t v : soup_.tree().triangle(i)) {
                if (soup_.around(v).front() == i) look_about(v);
            }
        }
    }

private:
    const SurfaceDistance& soup_;
    const std::span<const std::uint32_t> four_groups_;
    const double near_;
    Neighbourhood around_;
    std::vector<NearGroup> near_groups_;
    std::vector<std::uint32_t> beside_;
    std::vector<Start>& starts_;

    void look_about(std::uint32_t vertex) {
        const Vec3& point = soup_.position(vertex);
        const std::uint32_t own = soup_.group(soup_.around(vertex).front());
        near_groups_.clear();
        find_groups_beside(vertex, own);
        around_.visit_triangles(soup_.tree().box(point, point, near_), [&](std::size_t i) {
            const auto t = static_cast<std::uint32_t>(i);
            const std::uint32_t group = soup_.group(t);
            if (group == own || std::find(beside_.begin(), beside_.end(), group) != beside_.end()) return;
            NearGroup* known = nullptr;
            for (NearGroup& n : near_groups_) {
                if (n.group == group) known = &n;
            }
            if (known == nullptr) {
                known = &near_groups_.emplace_back(NearGroup{group, t, {}});
                known->closest.distance = near_;
            }
            if (soup_.tree().is_farther(point, i, known->closest.distance)) return;
            const Closest closest = closest_points(point, soup_.corners(t));
            if (closest.distance < known->closest.distance) *known = {group, t, closest};
        });
        for (const NearGroup& other : near_groups_) {
            if (other.closest.distance == 0 || other.closest.distance >= near_ || joined(vertex, other)) continue;
            for (const std::uint32_t group : soup_.groups_at(vertex)) {
                if (neighbours_are_farther(vertex, group, other)) starts_.push_back({group, vertex, other});
            }
        }
    }

    /// Groups that the vertex is on; those that its neighbours are on, too, where all of these are on its only group: they are
    /// closer.
    void find_groups_beside(std::uint32_t vertex, std::uint32_t own) {
        beside_.clear();
        const auto add_groups_at = [&](std::uint32_t v) {
            for (const std::uint32_t t : soup_.around(v)) {
                const std::uint32_t group = soup_.group(t);
                if (group != own && (beside_.empty() || beside_.back() != group)) beside_.push_back(group);
            }
        };
        add_groups_at(vertex);
        if (!beside_.empty()) return;
        for (const std::uint32_t t : soup_.around(vertex)) {
            for (const std::uint32_t v : soup_.triangle(t)) add_groups_at(v);
        }
    }

    /// A third group passes through both points.
    bool joined(std::uint32_t vertex, const NearGroup& other) const {
        const auto there = soup_.groups_around_part(other.triangle, other.closest.second_part);
        return std::ranges::any_of(there, [&](std::uint32_t group) { return soup_.on_group(vertex, group); });
    }

    /// Whether a triangle of the group, among those near the block, comes closer to the point than `distance`.
    bool has_closer(const Vec3& point, std::uint32_t group, double distance) const {
        bool found = false;
        around_.visit_triangles(soup_.tree().box(point, point, distance), [&](std::size_t i) {
            const auto t = static_cast<std::uint32_t>(i);
            if (found || soup_.group(t) != group || soup_.tree().is_farther(point, i, distance)) return;
            found = closest_points(point, soup_.corners(t)).distance < distance;
        });
        return found;
    }

    bool neighbours_are_farther(std::uint32_t vertex, std::uint32_t own, const NearGroup& other) const {
        const std::array<Vec3, 3> closest = soup_.corners(other.triangle);
        const auto all_neighbours = [&](const auto& is_farther) {
            return std::ranges::all_of(soup_.around(vertex), [&](std::uint32_t t) {
                return soup_.group(t) != own ||
                       std::ranges::all_of(soup_.triangle(t), [&](std::uint32_t v) { return v == vertex || is_farther(v); });
            });
        };
        const double distance = other.closest.distance;
        // Nearly always a neighbour is closer to the same triangle already.
        return all_neighbours([&](std::uint32_t v) { return closest_points(soup_.position(v), closest).distance >= distance; }) &&
               all_neighbours([&](std::uint32_t v) { return !soup_.on_group(v, other.group); }) &&
               all_neighbours([&](std::uint32_t v) { return !has_closer(soup_.position(v), other.group, distance); });
    }
};

class PairSearch {
public:
    PairSearch(const SurfaceDistance& soup, double near) : soup_(soup), near_(near) {}

    /// False when stopped.
    bool find_starts(const Monitor* monitor) {
        const std::size_t fours = soup_.tree().levels().front().size();
        const std::vector<std::uint32_t> groups = groups_of_fours(fours);
        const std::size_t blocks = (fours + fours_per_block - 1) / fours_per_block;
        std::vector<std::vector<Start>> parts((blocks + blocks_per_chunk - 1) / blocks_per_chunk);
        parallel_for_each_index(parts.size(), [&](std::size_t part) {
            if (monitor != nullptr && monitor->stopped()) return;
            StartSearch search(soup_, groups, near_, parts[part]);
            const std::size_t last = std::min(blocks, (part + 1) * blocks_per_chunk);
            for (std::size_t block = part * blocks_per_chunk; block != last; ++block) search.run(block);
        });
        for (const auto& part : parts) starts_.insert(starts_.end(), part.begin(), part.end());
        const auto distance = [](const Start& start) { return start.other.closest.distance; };
        std::ranges::stable_sort(starts_, {}, distance);
        return monitor == nullptr || !monitor->stopped();
    }

    std::vector<ClosePair> pairs() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, Best> all;
        for (const Start& start : starts_) {
            Best& best = all[{std::min(start.group, start.other.group), std::max(start.group, start.other.group)}];
            if (best.tries == tries_per_pair) continue;
            const auto found = descend(start);
            if (!found) continue;
            ++best.tries;
            if (best.tries == 1 || found->distance < best.pair.distance) best.pair = *found;
        }
        std::vector<ClosePair> list;
        for (const auto& [groups, best] : all) {
            if (best.tries > 0) list.push_back(best.pair);
        }
        return list;
    }

private:
    struct Best {
        int tries = 0;
        ClosePair pair{};
    };

    const SurfaceDistance& soup_;
    const double near_;
    std::vector<Start> starts_;  ///< the closest first

    std::vector<std::uint32_t> groups_of_fours(std::size_t count) const {
        std::vector<std::uint32_t> groups(count);
        for (std::size_t i = 0; i < soup_.tree().size(); ++i) {
            const std::uint32_t group = soup_.group(static_cast<std::uint32_t>(i));
            if (i % 4 == 0) groups[i / 4] = group;
            if (groups[i / 4] != group) groups[i / 4] = mixed;
        }
        return groups;
    }

    /// Moves both points over their surfaces for as long as they come closer. Nothing where they meet or where the place does not count.
    std::optional<ClosePair> descend(const Start& start) const {
        const std::uint32_t other = start.other.group;
        const std::uint32_t t = soup_.around_edge(start.vertex, start.vertex, start.group).front();
        Place place{t, start.other.triangle, start.other.closest};
        for (unsigned i = 0; i < 3; ++i) {
            if (soup_.triangle(t)[i] == start.vertex) place.closest.first_part = 1u << i;
        }
        while (true) {
            const auto next = closest_around(place, start.group, other);
            if (!next) return std::nullopt;
            if (next->closest.distance >= place.closest.distance - soup_.rounding(place.closest.on_first)) break;
            place = *next;
        }
        if (lie_on_one_group(place)) return std::nullopt;
        if (soup_.common_vertex_within(2 * near_, place.closest.on_first, start.group, other)) return std::nullopt;
        const Closest& c = place.closest;
        const std::uint32_t a = soup_.tree().number(place.triangle_a), b = soup_.tree().number(place.triangle_b);
        if (start.group < other) return ClosePair{start.group, other, a, b, c.distance, c.on_first, c.on_second};
        return ClosePair{other, start.group, b, a, c.distance, c.on_second, c.on_first};
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

std::vector<ClosePair> closest_pairs(const TriangleTree& tree, std::span<const std::uint32_t> groups, double near, const Monitor* monitor) {
    if (tree.size() == 0 || !(near > 0)) return {};
    const SurfaceDistance soup(tree, groups);
    PairSearch search(soup, near);
    if (!search.find_starts(monitor)) return {};
    return search.pairs();
}

std::vector<ClosePair> closest_pairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                     std::span<const std::uint32_t> groups, double near, const Monitor* monitor) {
    return closest_pairs(TriangleTree(vertices, triangles), groups, near, monitor);
}

}  // namespace geomend
