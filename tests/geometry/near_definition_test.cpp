// SPDX-License-Identifier: AGPL-3.0-or-later
// What counts as a near miss, worked out the slow way: all pairs of triangles, all pairs of neighbours, all ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "geometry/closest_points.h"
#include "geometry/near_misses.h"
#include "geometry/predicates.h"
#include "geometry/vectors.h"
#include "soups.h"
#include "support/seeds.h"

namespace geomend {
namespace {

using test::Soup;
using Edge = std::array<std::uint32_t, 2>;
using GroupPair = std::pair<std::uint32_t, std::uint32_t>;

double length(const Vec3& d) { return std::sqrt(dot(d, d)); }

/// All questions asked of all triangles.
class Slow {
public:
    Slow(const Soup& soup, double near) : s_(soup), near_(near) {
        for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
            const Triangle& v = s_.triangles[t];
            if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0] || in_line(s_.vertices[v[0]], s_.vertices[v[1]], s_.vertices[v[2]])) continue;
            usable_.push_back(t);
        }
    }

    std::array<Vec3, 3> corners(std::uint32_t t) const {
        const Triangle& v = s_.triangles[t];
        return {s_.vertices[v[0]], s_.vertices[v[1]], s_.vertices[v[2]]};
    }
    bool share(std::uint32_t a, std::uint32_t b) const {
        const Triangle &p = s_.triangles[a], &q = s_.triangles[b];
        return std::find_first_of(p.begin(), p.end(), q.begin(), q.end()) != p.end();
    }
    bool meet(std::uint32_t a, std::uint32_t b) const {
        return share(a, b) || meeting(s_.vertices, s_.triangles[a], s_.triangles[b]).kind != Meeting::none;
    }
    double distance(std::uint32_t a, std::uint32_t b) const { return meet(a, b) ? 0 : closest_points(corners(a), corners(b)).distance; }
    std::vector<std::uint32_t> of_group_at(const Vec3& p, std::uint32_t group) const {
        std::vector<std::uint32_t> found;
        for (const std::uint32_t t : usable_) {
            if (s_.groups[t] == group && closest_points(p, corners(t)).distance < 1e-9 * near_) found.push_back(t);
        }
        return found;
    }

    /// No two triangles around the two points are closer than the points.
    bool is_smallest(const Vec3& p, std::uint32_t group_a, const Vec3& q, std::uint32_t group_b) const {
        const double here = length(minus(p, q));
        for (const std::uint32_t a : of_group_at(p, group_a)) {
            for (const std::uint32_t b : of_group_at(q, group_b)) {
                if (distance(a, b) < here - 1e-9 * near_) return false;
            }
        }
        return true;
    }

    struct Place {
        double distance;
        std::uint32_t a, b;
        Vec3 on_a, on_b;
    };

    /// Where the distance of two groups is smallest, the closest first.
    std::map<GroupPair, std::vector<Place>> places() const {
        std::map<GroupPair, std::vector<Place>> found;
        for (const std::uint32_t a : usable_) {
            for (const std::uint32_t b : usable_) {
                if (s_.groups[a] >= s_.groups[b] || meet(a, b)) continue;
                const Closest c = closest_points(corners(a), corners(b));
                if (c.distance >= near_ || !is_smallest(c.on_first, s_.groups[a], c.on_second, s_.groups[b])) continue;
                found[{s_.groups[a], s_.groups[b]}].push_back({c.distance, a, b, c.on_first, c.on_second});
            }
        }
        for (auto& [pair, list] : found) std::ranges::stable_sort(list, {}, &Place::distance);
        return found;
    }

    /// Whether a way within `near`, and within 10 `near` of the place, leads to where both groups meet or stand on a third.
    bool leads_to_meeting(const Place& place) const {
        const std::uint32_t group_a = s_.groups[place.a], group_b = s_.groups[place.b];
        std::vector<std::uint32_t> of_a, of_b;
        for (const std::uint32_t t : usable_) {
            if (closest_points(place.on_a, corners(t)).distance > 10 * near_) continue;
            if (s_.groups[t] == group_a) of_a.push_back(t);
            if (s_.groups[t] == group_b) of_b.push_back(t);
        }
        std::set<std::pair<std::uint32_t, std::uint32_t>> reached{{place.a, place.b}};
        for (bool grown = true; grown;) {
            grown = false;
            for (const auto& [a, b] : std::set(reached)) {
                if (meet(a, b) || joined(a, b)) return true;
                for (const std::uint32_t next : of_a) {
                    if (share(a, next) && near_over(a, next, b)) grown = reached.insert({next, b}).second || grown;
                }
                for (const std::uint32_t next : of_b) {
                    if (share(b, next) && near_over(b, next, a)) grown = reached.insert({a, next}).second || grown;
                }
            }
        }
        return false;
    }

    std::map<GroupPair, Place> misses() const {
        std::map<GroupPair, Place> found;
        for (const auto& [pair, list] : places()) {
            std::vector<Place> excused;
            for (const Place& place : list) {
                const bool beside = std::ranges::any_of(excused, [&](const Place& other) {
                    return length(minus(place.on_a, other.on_a)) < near_ && length(minus(place.on_b, other.on_b)) < near_;
                });
                if (beside) continue;
                if (!leads_to_meeting(place)) {
                    found[pair] = place;
                    break;
                }
                excused.push_back(place);
            }
        }
        return found;
    }

    const std::vector<std::uint32_t>& usable() const { return usable_; }

private:
    const Soup& s_;
    const double near_;
    std::vector<std::uint32_t> usable_;

    /// What two triangles of one group have in common is near a third.
    bool near_over(std::uint32_t from, std::uint32_t to, std::uint32_t other) const {
        std::vector<Vec3> common;
        for (const std::uint32_t v : s_.triangles[from]) {
            if (std::ranges::count(s_.triangles[to], v) > 0) common.push_back(s_.vertices[v]);
        }
        return closest_points(std::array{common.front(), common[common.size() > 1 ? 1 : 0]}, corners(other)).distance < near_;
    }

    /// An edge or vertex of each that a third group has, near each other.
    bool joined(std::uint32_t a, std::uint32_t b) const {
        for (const std::uint32_t c : usable_) {
            for (const std::uint32_t d : usable_) {
                if (s_.groups[c] != s_.groups[d] || s_.groups[c] == s_.groups[a] || s_.groups[c] == s_.groups[b]) continue;
                for (const auto& p : parts(a, c)) {
                    for (const auto& q : parts(b, d)) {
                        if (closest_points(std::array{p[0], p[1], p[1]}, std::array{q[0], q[1], q[1]}).distance < near_) return true;
                    }
                }
            }
        }
        return false;
    }
    std::vector<std::array<Vec3, 2>> parts(std::uint32_t a, std::uint32_t c) const {
        std::vector<Vec3> common;
        for (const std::uint32_t v : s_.triangles[a]) {
            if (std::ranges::count(s_.triangles[c], v) > 0) common.push_back(s_.vertices[v]);
        }
        std::vector<std::array<Vec3, 2>> found;
        for (const Vec3& p : common) {
            for (const Vec3& q : common) found.push_back({p, q});
        }
        return found;
    }
};

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    std::uint32_t pick(std::size_t count) { return static_cast<std::uint32_t>(engine_() % count); }
    bool chance(double share) { return any(0, 1) < share; }

private:
    std::mt19937 engine_;
};

/// Rough patches of a few triangles each, turned every way and on top of each other; some have vertices or edges in common.
Soup patches(Random& random, std::uint32_t count, bool sharing) {
    Soup s;
    for (std::uint32_t g = 0; g < count; ++g) {
        const Vec3 centre{random.any(0, 1.2), random.any(0, 1.2), random.any(0, 0.8)};
        const Vec3 u{random.any(-1, 1), random.any(-1, 1), random.any(-1, 1)}, v{random.any(-1, 1), random.any(-1, 1), random.any(-1, 1)};
        const std::uint32_t nu = 1 + random.pick(3), nv = 1 + random.pick(3);
        const double rough = random.any(0, 0.3);
        const std::size_t before = s.triangles.size();
        const auto first = s.add_sheet(nu, nv, [&](double i, double j) {
            const Vec3 noise{rough * random.any(-1, 1), rough * random.any(-1, 1), rough * random.any(-1, 1)};
            return plus(plus(centre, noise), plus(times(i / nu - 0.5, u), times(j / nv - 0.5, v)));
        });
        if (g == 0 || !sharing || random.chance(0.3)) continue;
        std::map<std::uint32_t, std::uint32_t> rename{{first, random.pick(first)}};
        if (random.chance(0.6)) rename[first + 1] = random.pick(first);
        for (std::size_t t = before; t < s.triangles.size(); ++t) {
            for (std::uint32_t& w : s.triangles[t]) w = rename.contains(w) ? rename[w] : w;
        }
    }
    return s;
}

/// Two rough sheets that part along a line of common vertices at an angle.
Soup wedge(Random& random) {
    Soup s;
    const double angle = random.any(3, 60) * std::numbers::pi / 180, rough = random.any(0, 0.12);
    const std::uint32_t along = 2 + random.pick(2);
    const auto noise = [&] { return rough * random.any(-1, 1); };
    s.add_sheet(along, 3, [&](double i, double j) { return Vec3{i, j, j == 0 ? 0 : noise()}; });
    const std::uint32_t second = s.add_sheet(along, 4, [&](double i, double j) {
        return Vec3{i, 0.8 * j * std::cos(angle) + (j == 0 ? 0 : 0.1), 0.8 * j * std::sin(angle) + (j == 0 ? 0 : noise())};
    });
    for (Triangle& t : s.triangles) {
        for (std::uint32_t& v : t) v = v >= second && v <= second + along ? v - second : v;
    }
    return s;
}

/// Somewhere else and of another size, turned: near goes along.
double move(Soup& s, Random& random, double near) {
    const double scale = std::ldexp(random.any(1, 2), static_cast<int>(random.pick(41)) - 20);
    const Vec3 offset = random.chance(0.5) ? Vec3{} : times(random.any(0, 1e4) * scale, {0.5, 1, -0.1});
    const double angle = random.any(0, 6);
    for (Vec3& p : s.vertices) {
        p = plus(offset,
                 times(scale, {std::cos(angle) * p[0] - std::sin(angle) * p[1], std::sin(angle) * p[0] + std::cos(angle) * p[1], p[2]}));
    }
    return near * scale;
}

void expect_the_same(const Soup& s, double near, unsigned seed, std::map<std::string, int>& seen) {
    const auto expected = Slow(s, near).misses();
    const auto found = closest_pairs(s.vertices, s.triangles, s.groups, near).pairs;
    std::map<GroupPair, double> distances;
    for (const ClosePair& p : found) {
        distances[{p.group_a, p.group_b}] = p.distance;
        EXPECT_NEAR(length(minus(p.on_a, p.on_b)), p.distance, 1e-6 * near) << "seed " << seed;
        EXPECT_EQ(s.groups[p.triangle_a], p.group_a);
        EXPECT_EQ(s.groups[p.triangle_b], p.group_b);
    }
    ASSERT_EQ(distances.size(), found.size());
    for (const auto& [pair, place] : expected) {
        const Closest c = closest_points(Slow(s, near).corners(place.a), Slow(s, near).corners(place.b));
        ASSERT_TRUE(distances.contains(pair)) << "seed " << seed << ": " << pair.first << " and " << pair.second << " at " << place.distance
                                              << " of " << near << ", parts " << c.first_part << " and " << c.second_part;
        ASSERT_NEAR(distances[pair], place.distance, 1e-9 * near) << "seed " << seed;
        const bool at_vertex =
            c.first_part == 1 || c.first_part == 2 || c.first_part == 4 || c.second_part == 1 || c.second_part == 2 || c.second_part == 4;
        ++seen[at_vertex ? "at a vertex" : "between edges"];
    }
    EXPECT_EQ(distances.size(), expected.size()) << "seed " << seed;
}

TEST(NearDefinition, ClosestPairsAreTheSmallestOfAllPairsOfTriangles) {
    std::map<std::string, int> seen;
    for (unsigned seed = 0; seed < test::seeds(1500) && !HasFailure(); ++seed) {
        Random random(seed);
        Soup s = patches(random, 2 + seed % 2, seed % 3 != 0);
        const double near = move(s, random, random.any(0.02, 0.3));
        expect_the_same(s, near, seed, seen);
    }
    EXPECT_GT(seen["at a vertex"], 100);
    EXPECT_GT(seen["between edges"], 50);
}

TEST(NearDefinition, ClosestPairsOfSheetsThatPartAreTheSame) {
    std::map<std::string, int> seen;
    for (unsigned seed = 0; seed < test::seeds(400) && !HasFailure(); ++seed) {
        Random random(seed);
        Soup s = wedge(random);
        const double near = move(s, random, random.any(0.02, 0.4));
        expect_the_same(s, near, seed, seen);
    }
}

/// Edges that one triangle only has.
void find_borders(const Soup& s, std::vector<Edge>& edges, std::vector<std::uint32_t>& groups) {
    std::map<Edge, std::vector<std::uint32_t>> uses;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [p, q] = std::minmax(s.triangles[t][i], s.triangles[t][(i + 1) % 3]);
            uses[{p, q}].push_back(s.groups[t]);
        }
    }
    for (const auto& [edge, of] : uses) {
        if (of.size() > 1) continue;
        edges.push_back(edge);
        groups.push_back(of[0]);
    }
}

// Surfaces without common vertices: no holes, no wedges. Each border edge on which the distance to a group is smallest is told
// with that distance, and no group else.
TEST(NearDefinition, BordersAreToldWhereTheDistanceIsSmallest) {
    int seen = 0;
    for (unsigned seed = 0; seed < test::seeds(1500) && !HasFailure(); ++seed) {
        Random random(seed);
        Soup s = patches(random, 2 + seed % 2, false);
        const double near = move(s, random, random.any(0.02, 0.3));
        const Slow slow(s, near);
        std::vector<Edge> edges;
        std::vector<std::uint32_t> groups;
        find_borders(s, edges, groups);
        std::map<std::pair<std::uint32_t, std::uint32_t>, double> expected;  // edge, group
        std::set<GroupPair> expected_pairs;
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            const std::array<Vec3, 2> segment{s.vertices[edges[e][0]], s.vertices[edges[e][1]]};
            for (const std::uint32_t t : slow.usable()) {
                if (s.groups[t] == groups[e]) continue;
                const Closest c = closest_points(segment, slow.corners(t));
                if (c.distance == 0 || c.distance >= near || !slow.is_smallest(c.on_first, groups[e], c.on_second, s.groups[t])) continue;
                const auto [at, added] = expected.try_emplace({e, s.groups[t]}, c.distance);
                if (!added) at->second = std::min(at->second, c.distance);
                expected_pairs.insert({groups[e], s.groups[t]});
            }
        }
        std::map<std::pair<std::uint32_t, std::uint32_t>, double> found;
        std::set<GroupPair> found_pairs;
        for (const NearMiss& m : near_misses(s.vertices, s.triangles, s.groups, edges, groups, near)) {
            if (s.groups[m.triangle] == groups[m.border_edge]) continue;
            found[{m.border_edge, s.groups[m.triangle]}] = m.distance;
            found_pairs.insert({groups[m.border_edge], s.groups[m.triangle]});
        }
        for (const auto& [place, distance] : expected) {
            // The edge itself; or, where only its end is near, one beside it that is near all along.
            const auto tells = [&](const auto& other) {
                const auto& [edge, group] = other.first;
                const Edge &p = edges[place.first], &q = edges[edge];
                return group == place.second && other.second < distance + 1e-9 * near &&
                       std::find_first_of(p.begin(), p.end(), q.begin(), q.end()) != p.end();
            };
            ASSERT_TRUE(std::ranges::any_of(found, tells)) << "seed " << seed << " edge " << place.first << " at " << distance;
            ++seen;
        }
        ASSERT_EQ(found_pairs, expected_pairs) << "seed " << seed;
    }
    EXPECT_GT(seen, 1000);
}

}  // namespace
}  // namespace geomend
