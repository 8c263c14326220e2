// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/near_features.h"

#include <cmath>
#include <cstdlib>

#include "arrangement/segment_contact.h"
#include "geometry/vectors.h"

namespace geomend::arrangement {

namespace {

constexpr std::array<std::array<std::size_t, 2>, 3> ends_of_edge{{{0, 1}, {1, 2}, {2, 0}}};

/// Which corners of each have the same number in both.
struct Shared {
    std::array<bool, 3> of_a{}, of_b{};
    int count = 0;

    Shared(const Triangle& a, const Triangle& b) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                if (a[i] != b[j]) continue;
                of_a[i] = of_b[j] = true;
                ++count;
            }
        }
    }
};

/// All corners of `others` but the excepted are farther than the distance beyond one of the half-spaces around t: above its
/// plane, below, or outside of an edge.
bool are_beyond(const FlatTriangle& others, const std::array<bool, 3>& except, const FlatTriangle& t, double distance) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k) {
        if (except[k]) continue;
        const double height = dot(t.normal, minus(others.corner[k], t.corner[0]));
        low = std::min(low, height);
        high = std::max(high, height);
    }
    if (low > distance || high < -distance) return true;
    for (const auto& [i, j] : ends_of_edge) {
        const Vec3 edge = minus(t.corner[j], t.corner[i]), out = cross(edge, t.normal);
        double least = HUGE_VAL;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!except[k]) least = std::min(least, dot(out, minus(others.corner[k], t.corner[i])));
        }
        if (least > 0 && least * least > distance * distance * dot(edge, edge)) return true;
    }
    return false;
}

/// A single shared corner: t leaves it ahead, the other's corners lie behind it by more than the distance.
bool are_behind_corner(const FlatTriangle& others, const std::array<bool, 3>& except, const FlatTriangle& t,
                       const std::array<bool, 3>& shared, double distance) {
    const std::size_t w = shared[0] ? 0 : shared[1] ? 1 : 2;
    const Vec3 u = minus(t.corner[(w + 1) % 3], t.corner[w]), v = minus(t.corner[(w + 2) % 3], t.corner[w]);
    const Vec3 ahead = plus(u, v);
    if (dot(ahead, u) < 0 || dot(ahead, v) < 0) return false;
    const double reach = distance * length(ahead);
    for (std::size_t k = 0; k < 3; ++k) {
        if (!except[k] && dot(ahead, minus(others.corner[k], t.corner[w])) > -reach) return false;
    }
    return true;
}

/// The corner that is in none of the two shared ones.
std::size_t lone_corner(const std::array<bool, 3>& shared) { return !shared[0] ? 0 : !shared[1] ? 1 : 2; }

bool clear_at_shared_edge(const FlatTriangle& a, const FlatTriangle& b, const Shared& shared, double distance) {
    const std::size_t i = lone_corner(shared.of_a), j = lone_corner(shared.of_b);
    const Vec3 &p = b.corner[(j + 1) % 3], &q = b.corner[(j + 2) % 3];
    const Vec3 edge = minus(q, p), out = cross(edge, b.normal), w = minus(a.corner[i], p);
    const double beyond = dot(out, w);
    if (beyond > 0 && beyond * beyond > distance * distance * dot(edge, edge)) return true;
    return std::abs(dot(b.normal, w)) > distance && std::abs(dot(a.normal, minus(b.corner[j], p))) > distance;
}

/// What two triangles have in common, feature by feature.
class PairContact {
public:
    PairContact(const FlatTriangle& a, std::uint32_t number_a, const FlatTriangle& b, std::uint32_t number_b, double distance,
                NearFeatures& to)
        : side_{&a, &b}, number_{number_a, number_b}, distance_(distance), to_(to), shared_(a.vertex, b.vertex) {}

    void run() {
        const auto begin = static_cast<std::uint32_t>(to_.common.size());
        for (std::size_t i = 0; i < 3; ++i) {
            if (shared_.of_a[i]) to_.common.push_back(side_[0]->vertex[i]);
        }
        const std::size_t before = to_.common.size();
        vertices_on(0);
        vertices_on(1);
        edges_on_edges();
        edges_through(0);
        edges_through(1);
        const auto end = static_cast<std::uint32_t>(to_.common.size());
        if (end == before || end - begin < 2) to_.common.resize(begin);
        else to_.pairs.push_back({number_[0], number_[1], begin, end});
    }

private:
    std::array<const FlatTriangle*, 2> side_;
    std::array<std::uint32_t, 2> number_;
    double distance_;
    NearFeatures& to_;
    Shared shared_;
    std::array<std::array<bool, 3>, 2> corner_is_on_{};                   ///< a corner that is on the other triangle
    std::array<std::array<std::array<bool, 3>, 3>, 2> corner_on_edge_{};  ///< of side, corner, edge of the other
    std::array<std::array<bool, 3>, 2> edge_is_done_{};                   ///< an edge that meets an edge of the other

    const std::array<bool, 3>& shared(std::size_t side) const { return side == 0 ? shared_.of_a : shared_.of_b; }

    /// Corners of one on the edges or the inside of the other.
    void vertices_on(std::size_t side) {
        const FlatTriangle &from = *side_[side], &on = *side_[1 - side];
        for (std::size_t i = 0; i < 3; ++i) {
            if (shared(side)[i]) continue;
            const double height = dot(on.normal, minus(from.corner[i], on.corner[0]));
            if (std::abs(height) > distance_) continue;
            bool on_edge = false;
            for (std::size_t e = 0; e < 3; ++e) {
                const auto [p, q] = ends_of_edge[e];
                if (!is_near_segment(from.corner[i], on.corner[p], on.corner[q], distance_)) continue;
                on_edge = corner_on_edge_[side][i][e] = true;
                to_.on_edges.push_back({on.edge(e), from.vertex[i]});
            }
            if (!on_edge && !projects_inside(from.corner[i], on)) continue;
            if (!on_edge) to_.on_faces.push_back({number_[1 - side], from.vertex[i]});
            corner_is_on_[side][i] = true;
            to_.common.push_back(from.vertex[i]);
        }
    }

    static bool projects_inside(const Vec3& x, const FlatTriangle& t) {
        for (const auto& [i, j] : ends_of_edge) {
            if (dot(cross(minus(t.corner[j], t.corner[i]), t.normal), minus(x, t.corner[i])) >= 0) return false;
        }
        return true;
    }

    void edges_on_edges() {
        const FlatTriangle &a = *side_[0], &b = *side_[1];
        for (std::size_t e = 0; e < 3; ++e) {
            const auto [p, q] = ends_of_edge[e];
            for (std::size_t f = 0; f < 3; ++f) {
                const auto [r, s] = ends_of_edge[f];
                const Link first = a.edge(e), second = b.edge(f);
                if (first.has(second.a) || first.has(second.b)) continue;
                if (corner_on_edge_[0][p][f] || corner_on_edge_[0][q][f] || corner_on_edge_[1][r][e] || corner_on_edge_[1][s][e]) {
                    edge_is_done_[0][e] = edge_is_done_[1][f] = true;
                    continue;
                }
                NewPoint made{std::min(first, second), std::max(first, second)};
                const auto at = [](const FlatTriangle& t, std::size_t i, std::size_t j) {
                    return t.vertex[i] < t.vertex[j] ? std::array{t.corner[i], t.corner[j]} : std::array{t.corner[j], t.corner[i]};
                };
                auto one = at(a, p, q), two = at(b, r, s);
                if (second < first) std::swap(one, two);
                if (!pass_near(one[0], one[1], two[0], two[1], distance_, made.position)) continue;
                edge_is_done_[0][e] = edge_is_done_[1][f] = true;
                add(made);
            }
        }
    }

    void add(const NewPoint& made) {
        to_.common.push_back(NearFeatures::first_new + static_cast<std::uint32_t>(to_.points.size()));
        to_.points.push_back(made);
    }

    /// Edges of one that pierce the inside of the other.
    void edges_through(std::size_t side) {
        const FlatTriangle &from = *side_[side], &on = *side_[1 - side];
        for (std::size_t e = 0; e < 3; ++e) {
            auto [i, j] = ends_of_edge[e];
            if (shared(side)[i] || shared(side)[j] || edge_is_done_[side][e]) continue;
            if (corner_is_on_[side][i] || corner_is_on_[side][j]) continue;
            if (from.vertex[j] < from.vertex[i]) std::swap(i, j);
            const double hi = dot(on.normal, minus(from.corner[i], on.corner[0]));
            const double hj = dot(on.normal, minus(from.corner[j], on.corner[0]));
            if ((hi > 0) == (hj > 0)) continue;
            const Vec3 x = plus(from.corner[i], times(hi / (hi - hj), minus(from.corner[j], from.corner[i])));
            if (!projects_inside(x, on)) continue;
            add({from.edge(e), Link(number_[1 - side], number_[1 - side]), true, rounded(x)});
        }
    }
};

}  // namespace

FlatTriangle::FlatTriangle(std::span<const Vec3> points, const Triangle& t) : corner{points[t[0]], points[t[1]], points[t[2]]}, vertex(t) {
    normal = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    const double size = length(normal);
    normal = size > 0 ? times(1 / size, normal) : Vec3{};
}

bool keep_clear(const FlatTriangle& a, const FlatTriangle& b, double distance) {
    const Shared shared(a.vertex, b.vertex);
    switch (shared.count) {
        case 0:
            return are_beyond(a, {}, b, distance) || are_beyond(b, {}, a, distance);
        case 1:
            return (are_beyond(a, shared.of_a, b, distance) || are_behind_corner(a, shared.of_a, b, shared.of_b, distance)) &&
                   (are_beyond(b, shared.of_b, a, distance) || are_behind_corner(b, shared.of_b, a, shared.of_a, distance));
        case 2:
            return clear_at_shared_edge(a, b, shared, distance);
        default:
            return true;
    }
}

void add_near_features(const FlatTriangle& a, std::uint32_t number_a, const FlatTriangle& b, std::uint32_t number_b, double distance,
                       NearFeatures& to) {
    PairContact(a, number_a, b, number_b, distance, to).run();
}

void add_flat_corner(const FlatTriangle& t, double distance, NearFeatures& to) {
    for (std::size_t e = 0; e < 3; ++e) {
        const auto [p, q] = ends_of_edge[e];
        const std::size_t lone = 3 - p - q;
        if (is_near_segment(t.corner[lone], t.corner[p], t.corner[q], distance)) to.on_edges.push_back({t.edge(e), t.vertex[lone]});
    }
}

}  // namespace geomend::arrangement
