// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/near_misses.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "geometry/surface_distance.h"
#include "geometry/triangle_pair.h"
#include "geometry/vectors.h"

namespace geomend {

namespace {

using Edge = std::array<std::uint32_t, 2>;

/// The triangle of a group (by its place in the tree) that is closest to a border edge, without those that share a vertex with it.
struct Candidate {
    std::uint32_t group = 0, triangle = 0;
    Closest closest{};
    bool is_miss = false;
};

/// The border edges at each vertex, for those of one group.
class BorderGraph {
public:
    BorderGraph(std::span<const Edge> edges, std::span<const std::uint32_t> groups) {
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            for (const std::uint32_t v : edges[e]) ends_.push_back({{groups[e], v}, e});
        }
        std::sort(ends_.begin(), ends_.end());
    }
    /// Calls visit(edge) for the other edges of the group at a vertex.
    template <class Visit>
    void visit_others(std::uint32_t group, std::uint32_t vertex, std::uint32_t edge, const Visit& visit) const {
        const std::pair key{group, vertex};
        for (auto i = std::lower_bound(ends_.begin(), ends_.end(), End{key, 0}); i != ends_.end() && i->first == key; ++i) {
            if (i->second != edge) visit(i->second);
        }
    }

private:
    using End = std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;
    std::vector<End> ends_;
};

class BorderSearch {
public:
    BorderSearch(const SurfaceDistance& soup, std::span<const Edge> edges, std::span<const std::uint32_t> groups, double near,
                 double touching, double slow)
        : soup_(soup),
          edges_(edges),
          groups_(groups),
          near_(near),
          touching_(touching),
          slow_(slow),
          graph_(edges, groups),
          candidates_(edges.size()) {}

    /// Candidates, and which of them are smallest distances. False when stopped.
    bool find_candidates(const Monitor* monitor) {
        parallel_blocks(edges_.size(), 16, [&](std::size_t from, std::size_t to) {
            if (monitor != nullptr && monitor->stopped()) return;
            for (std::size_t e = from; e != to; ++e) find_candidates(static_cast<std::uint32_t>(e));
        });
        return monitor == nullptr || !monitor->stopped();
    }

    /// From the smallest distances along the border to where the distance stops growing.
    void spread() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting;  // edge, group
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            for (const Candidate& c : candidates_[e]) {
                if (c.is_miss && c.closest.distance > touching_) waiting.push_back({e, c.group});
            }
        }
        while (!waiting.empty()) {
            const auto [edge, group] = waiting.back();
            waiting.pop_back();
            const double distance = candidate(edge, group)->closest.distance;
            for (const std::uint32_t v : edges_[edge]) {
                graph_.visit_others(groups_[edge], v, edge, [&](std::uint32_t next) {
                    Candidate* c = candidate(next, group);
                    if (c == nullptr || c->is_miss || c->closest.distance < distance) return;
                    c->is_miss = true;
                    waiting.push_back({next, group});
                });
            }
        }
    }

    /// Edges that come near with one end only, beside one that is near all along at that end, say nothing new.
    void leave_out_stubs() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> stubs;  // edge, group
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            for (const Candidate& c : candidates_[e]) {
                if (!c.is_miss || !is_stub(e, c)) continue;
                const std::uint32_t end = edges_[e][c.closest.first_part == 1 ? 0 : 1];
                const auto others_there = others(e, end);
                const bool said = std::ranges::any_of(others_there, [&](std::uint32_t other) {
                    const Candidate* beside = candidate(other, c.group);
                    return beside != nullptr && beside->is_miss && !is_stub(other, *beside);
                });
                if (said) stubs.push_back({e, c.group});
            }
        }
        for (const auto& [edge, group] : stubs) candidate(edge, group)->is_miss = false;
    }

    void find_holes() {
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            for (std::size_t start = 0; start < 2; ++start) {
                for (const std::uint32_t group : soup_.groups_at(edges_[e][start])) {
                    if (group != groups_[e]) follow(e, start, group);
                }
            }
        }
    }

    std::vector<NearMiss> misses() {
        std::vector<NearMiss> found;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            std::sort(candidates_[e].begin(), candidates_[e].end(), [](const auto& p, const auto& q) { return p.group < q.group; });
            for (const Candidate& c : candidates_[e]) {
                if (c.is_miss)
                    found.push_back({e, soup_.tree().number(c.triangle), c.closest.distance, c.closest.on_first, c.closest.on_second});
            }
        }
        return found;
    }

private:
    const SurfaceDistance& soup_;
    std::span<const Edge> edges_;
    std::span<const std::uint32_t> groups_;
    const double near_, touching_, slow_;
    const BorderGraph graph_;
    std::vector<std::vector<Candidate>> candidates_;  ///< of each edge, one per group

    Candidate* candidate(std::uint32_t edge, std::uint32_t group) {
        for (Candidate& c : candidates_[edge]) {
            if (c.group == group) return &c;
        }
        return nullptr;
    }

    /// What an edge comes near of one group: whether it meets that somewhere by exact predicates, the closest triangle, the closest
    /// of those where the distance is smallest, and one that only rounding brings to 0; HUGE_VAL where there is none.
    struct Group {
        Candidate closest, smallest, rounded;
        bool touches = false;
    };

    static Group& group_in(std::map<std::uint32_t, Group>& groups, std::uint32_t group) {
        const auto [at, added] = groups.try_emplace(group);
        if (added) {
            for (Candidate* c : {&at->second.closest, &at->second.smallest, &at->second.rounded}) {
                c->group = group;
                c->closest.distance = HUGE_VAL;
            }
        }
        return at->second;
    }

    void find_candidates(std::uint32_t e) {
        const auto [p, q] = edges_[e];
        const std::array<Vec3, 2> segment{soup_.position(p), soup_.position(q)};
        Vec3 low{}, high{};
        for (std::size_t k = 0; k < 3; ++k) std::tie(low[k], high[k]) = std::minmax({segment[0][k], segment[1][k]});
        std::vector<std::uint32_t> ring;  // the vertices of the triangles around the edge
        std::map<std::uint32_t, Group> groups;
        soup_.tree().visit_triangles(soup_.tree().box(low, high, near_), [&](std::size_t i) {
            const auto t = static_cast<std::uint32_t>(i);
            const std::uint32_t group = soup_.group(t);
            const Triangle& corners = soup_.triangle(t);
            if (std::ranges::any_of(corners, [&](std::uint32_t v) { return v == p || v == q; })) return;
            if (group == groups_[e]) {
                if (ring.empty()) ring = ring_around(e);
                if (has_any_of(corners, ring)) return;
            }
            Candidate here{group, t, closest_points(segment, soup_.corners(t)), true};
            const double distance = here.closest.distance;
            if (distance >= near_) return;
            Group& known = group_in(groups, group);
            if (distance == 0) {
                known.touches = known.touches || touches(e, t);
                here.closest.distance = soup_.rounding(here.closest.on_first);
                known.rounded = here;
                return;
            }
            if (distance < known.closest.closest.distance) known.closest = here;
            if (distance < known.smallest.closest.distance && is_smallest(e, here)) known.smallest = here;
        });
        for (auto& [group, g] : groups) {
            if (!g.touches && g.rounded.closest.distance < near_ && !meets_beside(e, g.rounded)) {
                candidates_[e].push_back(g.rounded);
            } else if (g.smallest.closest.distance < near_) {
                candidates_[e].push_back(g.smallest);
            } else if (!g.touches) {
                g.closest.is_miss = false;
                candidates_[e].push_back(g.closest);
            }
        }
    }

    bool touches(std::uint32_t e, std::uint32_t triangle) const {
        const auto [p, q] = edges_[e];
        const auto beside = soup_.around_edge(p, q, groups_[e]);
        return std::ranges::any_of(beside, [&](std::uint32_t t) {
            return meeting(soup_.positions(), soup_.triangle(t), soup_.triangle(triangle)).kind != Meeting::none;
        });
    }

    /// The end that is not the closest point is not near.
    bool is_stub(std::uint32_t e, const Candidate& c) const {
        if (c.closest.first_part == 3) return false;
        const Vec3& far = soup_.position(edges_[e][c.closest.first_part == 1 ? 1 : 0]);
        const std::vector<std::uint32_t> ring = c.group == groups_[e] ? ring_around(e) : std::vector<std::uint32_t>{};
        bool near = false;
        soup_.tree().visit_triangles(soup_.tree().box(far, far, near_), [&](std::size_t i) {
            const auto t = static_cast<std::uint32_t>(i);
            if (near || soup_.group(t) != c.group || has_any_of(soup_.triangle(t), ring)) return;
            near = closest_points(far, soup_.corners(t)).distance < near_;
        });
        return !near;
    }

    static bool has_any_of(const Triangle& t, const std::vector<std::uint32_t>& sorted) {
        return std::ranges::any_of(t, [&](std::uint32_t v) { return std::binary_search(sorted.begin(), sorted.end(), v); });
    }

    std::vector<std::uint32_t> ring_around(std::uint32_t e) const {
        std::vector<std::uint32_t> ring;
        for (const std::uint32_t v : edges_[e]) {
            for (const std::uint32_t t : soup_.around_edge(v, v, groups_[e])) {
                ring.insert(ring.end(), soup_.triangle(t).begin(), soup_.triangle(t).end());
            }
        }
        std::sort(ring.begin(), ring.end());
        return ring;
    }

    /// Neither end can be moved along its surface so that they come closer.
    bool is_smallest(std::uint32_t e, const Candidate& c) const {
        const Closest& closest = c.closest;
        const auto [p, q] = edges_[e];
        if (!soup_.none_ahead(closest.on_first, closest.first_part == 2 ? q : p, closest.first_part == 1 ? p : q, groups_[e],
                              closest.apart))
            return false;
        if (!soup_.none_ahead_at_part(closest.on_second, c.triangle, closest.second_part, times(-1, closest.apart))) return false;
        return !meets_beside(e, c);
    }

    /// Whether both groups have a vertex in common as near by as they are apart.
    bool meets_beside(std::uint32_t e, const Candidate& c) const {
        return c.group != groups_[e] && soup_.common_vertex_within(2 * c.closest.distance, c.closest.on_first, groups_[e], c.group);
    }

    /// Part of the border of a hole: an edge, and the gap at its farther end.
    struct Step {
        std::uint32_t edge;
        Candidate gap;
    };

    /// Follows the border from a vertex on another group for as long as it keeps near that group: when it comes back to the
    /// group or ends, the edges passed are the border of a hole; else those up to where it has last left too slowly.
    void follow(std::uint32_t edge, std::size_t start, std::uint32_t group) {
        std::vector<Step> path;
        std::size_t slowly = 0;  // so many edges of the path
        std::uint32_t from = edges_[edge][start];
        Candidate before{group, 0, {}};
        double way = 0;
        while (path.size() < edges_.size()) {
            const std::uint32_t to = edges_[edge][edges_[edge][0] == from ? 1 : 0];
            if (soup_.on_group(to, group)) {
                if (path.empty()) before = gap_over_chord(from, to, group);
                if (before.closest.distance > 0) path.push_back({edge, before});
                return keep(path);
            }
            const Vec3 step = minus(soup_.position(to), soup_.position(from));
            const double length = std::sqrt(dot(step, step));
            Candidate here = gap_at(soup_.position(to), group);
            if (here.closest.distance == 0) return;
            if (here.closest.distance >= near_) {
                // On the way there it may have left slowly for as long as it was near.
                const double last = near_ / slow_ - way;
                if (last > 0 && last < length) here = gap_at(plus(soup_.position(from), times(last / length, step)), group);
                if (here.closest.distance > 0 && here.closest.distance < near_ && runs_beside(edge, here.closest)) {
                    path.push_back({edge, here});
                    slowly = path.size();
                }
                break;
            }
            way += length;
            path.push_back({edge, here.closest.distance > before.closest.distance ? here : before});
            if (here.closest.distance <= slow_ * way && runs_beside(edge, here.closest)) slowly = path.size();
            const std::vector<std::uint32_t> next = others(edge, to);
            if (next.empty()) return keep(path);
            if (next.size() > 1) break;
            edge = next.front();
            from = to;
            before = here;
        }
        path.resize(slowly);
        keep(path);
    }

    Candidate gap_at(const Vec3& point, std::uint32_t group) const {
        Candidate gap{group, 0, {}};
        gap.closest = soup_.from_group(point, group, near_, gap.triangle);
        return gap;
    }

    /// Whether the surface leaves the other one across its border, more steeply than along it. Where a whole surface
    /// leaves another one slowly, as beds do that wedge out, so does its border, which is no miss.
    bool runs_beside(std::uint32_t edge, const Closest& gap) const {
        const auto [p, q] = edges_[edge];
        const Vec3 along = minus(soup_.position(q), soup_.position(p));
        for (const std::uint32_t t : soup_.around_edge(p, q, groups_[edge])) {
            for (const std::uint32_t v : soup_.triangle(t)) {
                if (v == p || v == q) continue;
                const Vec3 inward = across(minus(soup_.position(v), soup_.position(p)), along);
                const double rise = -dot(inward, gap.apart) / std::sqrt(dot(inward, inward));
                if (rise < std::abs(dot(along, gap.apart)) / std::sqrt(dot(along, along))) return false;
            }
        }
        return true;
    }

    std::vector<std::uint32_t> others(std::uint32_t edge, std::uint32_t vertex) const {
        std::vector<std::uint32_t> found;
        graph_.visit_others(groups_[edge], vertex, edge, [&](std::uint32_t other) { found.push_back(other); });
        return found;
    }

    /// Both ends of a border edge are on the group: the largest gap between them, 0 where the group has this edge, too. It grows
    /// steadily from either end to where an edge of the group runs across.
    Candidate gap_over_chord(std::uint32_t from, std::uint32_t to, std::uint32_t group) const {
        if (!soup_.around_edge(from, to, group).empty()) return {group, 0, {}};
        const Vec3 along = minus(soup_.position(to), soup_.position(from));
        const auto gap_after = [&](double share) { return gap_at(plus(soup_.position(from), times(share, along)), group); };
        constexpr int samples = 16, halvings = 24;
        double width = 1.0 / samples, at = width;
        Candidate widest = gap_after(at);
        const auto take = [&](double share) {
            const Candidate gap = gap_after(share);
            if (gap.closest.distance <= widest.closest.distance) return;
            widest = gap;
            at = share;
        };
        for (int i = 2; i < samples; ++i) take(i * width);
        for (int i = 0; i < halvings; ++i) {
            width *= 0.5;
            const double middle = at;
            take(middle - width);
            take(middle + width);
        }
        if (widest.closest.distance >= near_) widest.closest.distance = 0;
        return widest;
    }

    void keep(const std::vector<Step>& path) {
        for (const Step& step : path) {
            Candidate* known = candidate(step.edge, step.gap.group);
            if (known == nullptr) known = &candidates_[step.edge].emplace_back();
            *known = step.gap;
            known->is_miss = true;
        }
    }
};

}  // namespace

std::vector<NearMiss> near_misses(const SurfaceDistance& soup, std::span<const Edge> border_edges,
                                  std::span<const std::uint32_t> border_groups, double near, const Monitor* monitor, double touching,
                                  double slow) {
    if (border_edges.empty() || soup.tree().size() == 0 || !(near > 0)) return {};
    BorderSearch search(soup, border_edges, border_groups, near, touching, slow);
    if (!search.find_candidates(monitor)) return {};
    search.spread();
    search.leave_out_stubs();
    search.find_holes();
    return search.misses();
}

std::vector<NearMiss> near_misses(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                  std::span<const std::uint32_t> groups, std::span<const Edge> border_edges,
                                  std::span<const std::uint32_t> border_groups, double near, const Monitor* monitor) {
    if (border_edges.empty()) return {};
    const TriangleTree tree(vertices, triangles);
    return near_misses(SurfaceDistance(tree, groups), border_edges, border_groups, near, monitor);
}

}  // namespace geomend
