// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "geometry/near_misses.h"
#include "geometry/near_triangles.h"
#include "geometry/surface_distance.h"
#include "geometry/surface_walk.h"
#include "geometry/vectors.h"

// Where two surfaces are closest, either a vertex of one of them is nearest to something of the other, or the insides of two
// edges are nearest to each other: wherever else the distance is smallest, an edge or a triangle is parallel to the other, and
// one can go on to such a place. So all these are looked at. In the directions in which a triangle leaves a point the distance
// grows where each of its corners lies behind the plane through that point across the line to the closest point.

namespace geomend {

namespace {

constexpr std::size_t chunk_level = 4, chunk_size = 1024;  // what one thread does at a time: the triangles of a node of this level
// Beyond these everything is near everything.
constexpr std::size_t most_pairs_per_chunk = 150 * chunk_size, most_walks = 1000;

/// A place where the distance between two groups is smallest.
struct Place {
    std::uint32_t group_a, group_b, triangle_a, triangle_b;  ///< group_a < group_b; triangles by their places in the tree
    Closest closest;                                         ///< its first is a
};

/// A triangle, the box around it, and its plane with what counts as too far from it.
struct Body {
    std::array<Vec3, 3> corners;
    Vec3 low, high, normal;
    double limit = 0, rounding = 0;  ///< of heights along the normal; the second for each unit of reach
};

Body body_of(const std::array<Vec3, 3>& corners, double near) {
    Body body{corners, corners[0], corners[0], {}, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        body.low[axis] = std::min({corners[0][axis], corners[1][axis], corners[2][axis]});
        body.high[axis] = std::max({corners[0][axis], corners[1][axis], corners[2][axis]});
    }
    const Vec3 u = minus(corners[1], corners[0]), v = minus(corners[2], corners[0]);
    body.normal = cross(u, v);
    body.limit = near * std::sqrt(dot(body.normal, body.normal)) * (1 + 1e-12);
    body.rounding = 1e-14 * (dot(u, u) + dot(v, v));
    return body;
}

/// Which vertices and edges (edge k from corner k on) of a triangle may be as near another as asked: neither by their boxes nor by
/// the plane of the other one farther from it.
struct Features {
    std::uint8_t vertices = 0, edges = 0;
    bool is_apart = false;  ///< all of the triangle lies too far away on one side of the other: so does the other one from it
    bool any() const { return (vertices | edges) != 0; }
};

Features features_near(const std::array<Vec3, 3>& own, const Body& other, double near) {
    Vec3 heights{};
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 way = minus(own[k], other.corners[0]);
        reach = std::max(reach, std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]));
        heights[k] = dot(other.normal, way);
    }
    const double beyond = other.limit + other.rounding * reach, wide = near * (1 + 1e-6);
    Features found;
    // Most are: their boxes are near each other, since that is how they were found.
    found.is_apart = std::min({heights[0], heights[1], heights[2]}) > beyond || std::max({heights[0], heights[1], heights[2]}) < -beyond;
    if (found.is_apart) return found;
    // Of each corner, the sides of the other's box and plane on which it is too far away.
    std::array<unsigned, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k) {
        sides[k] = unsigned{heights[k] > beyond} | unsigned{heights[k] < -beyond} << 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = own[k][axis];
            sides[k] |= unsigned{x - other.high[axis] > wide} << (2 + 2 * axis) | unsigned{other.low[axis] - x > wide} << (3 + 2 * axis);
        }
    }
    found.is_apart = (sides[0] & sides[1] & sides[2]) != 0;
    for (std::size_t k = 0; k < 3; ++k) {
        found.vertices |= static_cast<std::uint8_t>(unsigned{sides[k] == 0} << k);
        found.edges |= static_cast<std::uint8_t>(unsigned{(sides[k] & sides[(k + 1) % 3]) == 0} << k);
    }
    return found;
}

/// Finds places from the vertices and edges of some triangles.
class PlaceSearch {
public:
    /// \param near of each group
    PlaceSearch(const SurfaceDistance& soup, std::span<const double> near, std::vector<Place>& places)
        : soup_(soup), near_of_(near), places_(places) {}

    void run(const NearTriangles& all) {
        for (std::uint32_t i = 0; i < all.size(); ++i) {
            if (all.at(i).empty()) continue;
            const std::uint32_t t = all.first() + i;
            near_ = near_of_[soup_.group(t)];
            take_near(t, all.at(i));
            look_from(t, others_);
            for (const Target& from : seen_from_) {
                const Target back{t, from.features, from.own_edges};
                look_from(from.triangle, std::span(&back, 1));
            }
        }
    }

private:
    /// A triangle to look at, the features of the one that looks from which it may be near, and which of its own edges may be.
    struct Target {
        std::uint32_t triangle = 0;
        Features features;
        std::uint8_t own_edges = 0;
    };

    const SurfaceDistance& soup_;
    const std::span<const double> near_of_;
    double near_ = 0;  ///< of the triangle at hand
    std::vector<Place>& places_;
    std::vector<Target> others_;     ///< near the one at hand
    std::vector<Target> seen_from_;  ///< triangles from which the one at hand may be near, and their features
    std::vector<Vec3> ways_;

    /// From the vertices and edges of a triangle to others, none of which shares a vertex with it: those come closer to it wherever
    /// one starts.
    void look_from(std::uint32_t t, std::span<const Target> others) {
        if (others.empty()) return;
        for (std::size_t k = 0; k < 3; ++k) {
            look_about(t, k, others);
            look_along(t, k, others);
        }
    }

    /// Each two edges are met once, from the lower group; only where both may be near.
    void take_near(std::uint32_t t, std::span<const std::uint32_t> others) {
        others_.clear();
        seen_from_.clear();
        const Body own = body_of(soup_.corners(t), near_);
        for (const std::uint32_t other : others) {
            const std::array<Vec3, 3> corners = soup_.corners(other);
            Features from_other = features_near(corners, own, near_);
            if (from_other.is_apart) continue;
            Features from_own = features_near(own.corners, body_of(corners, near_), near_);
            if (from_own.is_apart) continue;
            const std::uint8_t own_edges = from_own.edges, other_edges = from_other.edges;
            if (soup_.group(t) < soup_.group(other) || own_edges == 0) from_other.edges = 0;
            if (soup_.group(t) > soup_.group(other) || other_edges == 0) from_own.edges = 0;
            if (from_own.any()) others_.push_back({other, from_own, other_edges});
            if (from_other.any()) seen_from_.push_back({other, from_other, own_edges});
        }
    }

    /// The first triangle of its group that has this edge, or vertex where p = q.
    bool is_first_at_edge(std::uint32_t t, std::uint32_t p, std::uint32_t q) const {
        for (const std::uint32_t other : soup_.around(p)) {
            if (soup_.group(other) == soup_.group(t) && soup_.has(other, q)) return other == t;
        }
        return true;
    }

    /// Whether it is a triangle's turn to look from one of its vertices or edges; seldom asked.
    enum class Turn : std::uint8_t { unknown, its_own, of_another };

    bool is_first_at(std::uint32_t t, std::uint32_t p, std::uint32_t q, Turn& turn) {
        if (turn == Turn::unknown) {
            turn = is_first_at_edge(t, p, q) ? Turn::its_own : Turn::of_another;
            if (turn == Turn::its_own) find_ways(t, p, q);
        }
        return turn == Turn::its_own;
    }

    /// The directions in which the triangles at a vertex or edge leave it.
    void find_ways(std::uint32_t t, std::uint32_t p, std::uint32_t q) {
        ways_.clear();
        const Vec3 along = minus(soup_.position(q), soup_.position(p));
        for (const std::uint32_t other : soup_.around(p)) {
            if (soup_.group(other) != soup_.group(t) || !soup_.has(other, q)) continue;
            for (const std::uint32_t v : soup_.triangle(other)) {
                if (v == p || v == q) continue;
                const Vec3 way = minus(soup_.position(v), soup_.position(p));
                ways_.push_back(p == q ? way : across(way, along));
            }
        }
    }

    /// A triangle that lies wholly ahead in one of these directions: from there one gets closer to it. Rounding is none here.
    bool has_all_ahead(std::uint32_t t, const Vec3& from) const {
        const std::array<Vec3, 3> corners = soup_.corners(t);
        const std::array<Vec3, 3> to{minus(corners[0], from), minus(corners[1], from), minus(corners[2], from)};
        return std::ranges::any_of(ways_, [&](const Vec3& way) {
            const double least = std::min({dot(to[0], way), dot(to[1], way), dot(to[2], way)});
            return least > 0 && least * least > 1e-18 * near_ * near_ * dot(way, way);
        });
    }

    // ---- a vertex, and whatever of another group is closest to it there

    void look_about(std::uint32_t t, std::size_t k, std::span<const Target> others) {
        const std::uint32_t vertex = soup_.triangle(t)[k];
        const Vec3& point = soup_.position(vertex);
        const std::uint32_t own = soup_.group(t);
        Turn turn = Turn::unknown;
        for (const auto& [other, features, edges] : others) {
            if ((features.vertices >> k & 1) == 0) continue;
            if (!is_first_at(t, vertex, vertex, turn)) return;
            if (has_all_ahead(other, point)) continue;
            Closest closest = closest_points(point, soup_.corners(other));
            if (!(closest.distance > 0) || closest.distance >= near_) continue;
            if (!soup_.none_ahead(point, vertex, vertex, own, closest.apart)) continue;
            if (!soup_.none_ahead_at_part(closest.on_second, other, closest.second_part, times(-1, closest.apart))) continue;
            // The point is met once: from the first triangle that has it.
            if (soup_.around_part(other, closest.second_part, soup_.group(other)).front() != other) continue;
            closest.first_part = 1u << k;
            add({own, soup_.group(other), t, other, closest});
        }
    }

    void add(const Place& place) {
        if (place.group_a < place.group_b) {
            places_.push_back(place);
            return;
        }
        const Closest& c = place.closest;
        places_.push_back({place.group_b,
                           place.group_a,
                           place.triangle_b,
                           place.triangle_a,
                           {c.distance, c.on_second, c.on_first, times(-1, c.apart), c.second_part, c.first_part}});
    }

    // ---- the insides of two edges; each two are met once, from the lower group

    void look_along(std::uint32_t t, std::size_t k, std::span<const Target> others) {
        const std::uint32_t p = soup_.triangle(t)[k], q = soup_.triangle(t)[(k + 1) % 3];
        Turn turn = Turn::unknown;
        for (const auto& [other, features, edges] : others) {
            if ((features.edges >> k & 1) == 0) continue;
            if (!is_first_at(t, p, q, turn)) return;
            if (has_all_ahead(other, soup_.position(p))) continue;
            for (std::size_t m = 0; m < 3; ++m) {
                if ((edges >> m & 1) != 0) try_edges(t, k, other, m);
            }
        }
    }

    void try_edges(std::uint32_t t, std::size_t k, std::uint32_t other, std::size_t m) {
        const std::uint32_t p = soup_.triangle(t)[k], q = soup_.triangle(t)[(k + 1) % 3];
        const std::uint32_t r = soup_.triangle(other)[m], s = soup_.triangle(other)[(m + 1) % 3];
        const Vec3& from = soup_.position(p);
        const Vec3 u = minus(soup_.position(q), from), v = minus(soup_.position(s), soup_.position(r));
        const Vec3 w = minus(soup_.position(r), from), normal = cross(u, v);
        const double square = dot(normal, normal), height = dot(normal, w);
        if (!(height * height < near_ * near_ * square) || height == 0) return;
        const double on_u = dot(cross(w, v), normal), on_v = dot(cross(w, u), normal);
        if (!(on_u > 0) || on_u >= square || !(on_v > 0) || on_v >= square) return;
        const Vec3 apart = times(height / square, normal);
        const Vec3 on_first = plus(from, times(on_u / square, u)), on_second = plus(soup_.position(r), times(on_v / square, v));
        if (!soup_.none_ahead(on_first, p, q, soup_.group(t), apart)) return;
        if (!soup_.none_ahead(on_second, r, s, soup_.group(other), times(-1, apart)) || !is_first_at_edge(other, r, s)) return;
        Closest closest;
        closest.distance = std::abs(height) / std::sqrt(square);
        closest.on_first = on_first;
        closest.on_second = on_second;
        closest.apart = apart;
        closest.first_part = 1u << k | 1u << (k + 1) % 3;
        closest.second_part = 1u << m | 1u << (m + 1) % 3;
        if (closest.distance > 0 && closest.distance < near_) add({soup_.group(t), soup_.group(other), t, other, closest});
    }
};

class PairSearch {
public:
    /// \param near of each group
    PairSearch(const SurfaceDistance& soup, std::span<const double> near) : soup_(soup), near_of_(near) {}

    /// False when stopped.
    bool find_places(const Monitor* monitor) {
        const std::size_t level = std::min(chunk_level, soup_.tree().levels().size() - 1);
        const NodeGroups groups(soup_.groups(), level + 1);
        std::vector<std::vector<Place>> parts(soup_.tree().levels()[level].size());
        std::vector<std::uint8_t> crowded(parts.size(), 0);
        parallel_for_each_index(parts.size(), [&](std::size_t part) {
            if (monitor != nullptr && monitor->stopped()) return;
            NearTriangles near(soup_, groups, near_of_);
            crowded[part] = near.collect(level, part, most_pairs_per_chunk) ? 0 : 1;
            PlaceSearch(soup_, near_of_, parts[part]).run(near);
        });
        for (std::size_t part = 0; part < parts.size(); ++part) {
            if (crowded[part] != 0) note_groups(part);
        }
        for (const auto& part : parts) places_.insert(places_.end(), part.begin(), part.end());
        std::ranges::sort(places_, [](const Place& p, const Place& q) {
            if (p.group_a != q.group_a) return p.group_a < q.group_a;
            if (p.group_b != q.group_b) return p.group_b < q.group_b;
            if (p.closest.distance != q.closest.distance) return p.closest.distance < q.closest.distance;
            return std::pair(p.closest.on_first, p.closest.on_second) < std::pair(q.closest.on_first, q.closest.on_second);
        });
        return monitor == nullptr || !monitor->stopped();
    }

    /// The groups near which not everything was looked at, ascending.
    std::vector<std::uint32_t> cut_short() {
        std::ranges::sort(cut_short_);
        const auto repeats = std::ranges::unique(cut_short_);
        cut_short_.erase(repeats.begin(), repeats.end());
        return cut_short_;
    }

    std::vector<ClosePair> pairs(const Monitor* monitor) {
        std::vector<std::size_t> first;  // place of each two groups
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (i == 0 || places_[i].group_a != places_[i - 1].group_a || places_[i].group_b != places_[i - 1].group_b) first.push_back(i);
        }
        first.push_back(places_.size());
        std::vector<std::vector<ClosePair>> found(first.size() - 1);
        std::vector<std::uint8_t> crowded(found.size(), 0);
        parallel_for_each_index(found.size(), [&](std::size_t i) {
            if (monitor != nullptr && monitor->stopped()) return;
            const auto miss = closest_miss(std::span(places_).subspan(first[i], first[i + 1] - first[i]), crowded[i]);
            if (miss != nullptr) found[i].push_back(pair_at(*miss));
        });
        for (std::size_t i = 0; i < crowded.size(); ++i) {
            if (crowded[i] != 0) cut_short_.insert(cut_short_.end(), {places_[first[i]].group_a, places_[first[i]].group_b});
        }
        std::vector<ClosePair> list;
        for (const auto& pair : found) list.insert(list.end(), pair.begin(), pair.end());
        return monitor == nullptr || !monitor->stopped() ? list : std::vector<ClosePair>{};
    }

private:
    const SurfaceDistance& soup_;
    const std::span<const double> near_of_;
    std::vector<Place> places_;  ///< by groups, then the closest first
    std::vector<std::uint32_t> cut_short_;

    void note_groups(std::size_t part) {
        const std::size_t last = std::min(soup_.tree().size(), (part + 1) * chunk_size);
        for (std::size_t i = part * chunk_size; i < last; ++i) {
            const std::uint32_t group = soup_.group(static_cast<std::uint32_t>(i));
            if (cut_short_.empty() || cut_short_.back() != group) cut_short_.push_back(group);
        }
    }

    ClosePair pair_at(const Place& place) const {
        const Closest& c = place.closest;
        return {place.group_a, place.group_b, soup_.tree().number(place.triangle_a), soup_.tree().number(place.triangle_b), c.distance,
                c.on_first,    c.on_second};
    }

    /// The closest place from which no short way leads to where the groups meet; null where there is none.
    const Place* closest_miss(std::span<const Place> places, std::uint8_t& crowded) const {
        std::vector<const Place*> joined;
        const double near = near_of_[places.front().group_a];
        const auto within_near = [&](const Vec3& p, const Vec3& q) {
            const Vec3 d = minus(p, q);
            return dot(d, d) < near * near;
        };
        for (const Place& place : places) {
            const auto is_beside = [&](const Place* other) {
                return within_near(place.closest.on_first, other->closest.on_first) &&
                       within_near(place.closest.on_second, other->closest.on_second);
            };
            if (std::ranges::any_of(joined, is_beside)) continue;
            if (!leads_to_meeting(soup_, place.triangle_a, place.triangle_b, place.closest.on_first, near)) return &place;
            joined.push_back(&place);
            if (joined.size() < most_walks) continue;
            crowded = 1;
            break;
        }
        return nullptr;
    }
};

}  // namespace

ClosePairs closest_pairs(const SurfaceDistance& soup, std::span<const double> near, const Monitor* monitor) {
    if (soup.tree().size() == 0) return {};
    PairSearch search(soup, near);
    if (!search.find_places(monitor)) return {};
    ClosePairs found;
    found.pairs = search.pairs(monitor);
    found.cut_short = search.cut_short();
    return found;
}

ClosePairs closest_pairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::span<const std::uint32_t> groups,
                         double near, const Monitor* monitor) {
    const TriangleTree tree(vertices, triangles);
    const std::uint32_t last = groups.empty() ? 0 : *std::ranges::max_element(groups);
    const std::vector<double> all(std::size_t{last} + 1, near);
    return closest_pairs(SurfaceDistance(tree, groups), all, monitor);
}

}  // namespace geomend
