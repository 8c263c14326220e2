// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/single_valued.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/predicates.h"
#include "geometry/vectors.h"

namespace geomend {

namespace {

using Edge = std::array<std::uint32_t, 2>;
constexpr std::uint32_t none = 0xffffffff;

/// The axis that most of the area faces.
unsigned facing_axis(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
    Vec3 sum{};
    for (const Triangle& t : triangles) {
        const Vec3& p = vertices[t[0]];
        sum = plus(sum, cross(minus(vertices[t[1]], p), minus(vertices[t[2]], p)));
    }
    unsigned axis = std::abs(sum[0]) >= std::abs(sum[1]) ? 0 : 1;
    if (!(std::abs(sum[axis]) >= std::abs(sum[2]))) axis = 2;
    return axis;
}

/// The way in which all triangles turn, seen from the far end of an axis; 0 where they do not turn alike.
int common_turn(std::span<const Vec3> vertices, std::span<const Triangle> triangles, unsigned axis) {
    int turn = 0;
    for (const Triangle& t : triangles) {
        const int own = orientation_2d(vertices[t[0]], vertices[t[1]], vertices[t[2]], axis);
        if (own == 0 || own == -turn) return 0;
        turn = own;
    }
    return turn;
}

/// The edges without those that are there once in each direction; false where one is there more often.
bool find_border(std::span<const Edge> open_edges, std::vector<Edge>& border) {
    std::vector<Edge> sorted(open_edges.begin(), open_edges.end());
    const auto low_to_high = [](const Edge& e) { return Edge{std::min(e[0], e[1]), std::max(e[0], e[1])}; };
    std::ranges::sort(sorted, {}, low_to_high);
    for (std::size_t i = 0; i < sorted.size();) {
        std::size_t end = i + 1;
        while (end < sorted.size() && low_to_high(sorted[end]) == low_to_high(sorted[i])) ++end;
        if (end - i > 2 || (end - i == 2 && sorted[i] == sorted[i + 1])) return false;
        if (end - i == 1) border.push_back(sorted[i]);
        i = end;
    }
    return true;
}

/// The border of a surface, seen along an axis.
class BorderRings {
public:
    BorderRings(std::span<const Vec3> vertices, std::vector<Edge> edges, unsigned axis)
        : vertices_(vertices), edges_(std::move(edges)), axis_(axis), x_((axis + 1) % 3), y_((axis + 2) % 3) {}

    /// Links the edges to rings; false where more than one edge starts or ends at a vertex.
    bool link() {
        std::ranges::sort(edges_);
        std::vector<std::uint8_t> is_entered(edges_.size(), 0);
        next_.assign(edges_.size(), none);
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            if (i > 0 && edges_[i - 1][0] == edges_[i][0]) return false;
            const auto at = std::ranges::lower_bound(edges_, edges_[i][1], {}, [](const Edge& e) { return e[0]; });
            if (at == edges_.end() || (*at)[0] != edges_[i][1]) return false;
            const auto next = static_cast<std::uint32_t>(at - edges_.begin());
            if (is_entered[next] != 0) return false;
            is_entered[next] = 1;
            next_[i] = next;
        }
        return !edges_.empty();
    }

    /// Whether no two edges have a point in common but the vertex that they share. Goes along the longer side with those edges at
    /// hand that reach so far; gives up, with false, where these are too many.
    bool is_simple() const {
        const unsigned along = extent(x_) >= extent(y_) ? x_ : y_, across = along == x_ ? y_ : x_;
        std::vector<std::uint32_t> order(edges_.size()), at_hand;
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::ranges::sort(order, {}, [&](std::uint32_t e) { return low(e, along); });
        std::size_t left = 1000 + 64 * edges_.size();
        for (const std::uint32_t e : order) {
            std::erase_if(at_hand, [&](std::uint32_t other) { return high(other, along) < low(e, along); });
            if (at_hand.size() > left) return false;
            left -= at_hand.size();
            for (const std::uint32_t other : at_hand) {
                if (low(e, across) > high(other, across) || high(e, across) < low(other, across)) continue;
                if (meet(e, other)) return false;
            }
            at_hand.push_back(e);
        }
        return true;
    }

    /// Whether no two rings that go round as the triangles turn, from outside, may lie in each other. \pre is_simple()
    bool has_outer_rings_apart(int turn) const {
        struct Extent {
            double low_x, high_x, low_y, high_y;
        };
        std::vector<Extent> outer;
        std::vector<std::uint8_t> seen(edges_.size(), 0);
        for (std::uint32_t start = 0; start < edges_.size(); ++start) {
            if (seen[start] != 0) continue;
            std::uint32_t lowest = start;  // the edge that ends at the ring's first vertex by x, then y
            Extent extent{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
            for (std::uint32_t e = start; seen[e] == 0; e = next_[e]) {
                seen[e] = 1;
                const Vec3 &p = end(e), &q = end(lowest);
                if (p[x_] < q[x_] || (p[x_] == q[x_] && p[y_] < q[y_])) lowest = e;
                extent = {std::min(extent.low_x, p[x_]), std::max(extent.high_x, p[x_]), std::min(extent.low_y, p[y_]),
                          std::max(extent.high_y, p[y_])};
            }
            const int ring = orientation_2d(vertices_[edges_[lowest][0]], end(lowest), end(next_[lowest]), axis_);
            if (ring == turn) outer.push_back(extent);
            if (outer.size() > most_outer) return false;
        }
        for (std::size_t i = 0; i < outer.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const Extent &a = outer[i], &b = outer[j];
                if (a.low_x <= b.high_x && b.low_x <= a.high_x && a.low_y <= b.high_y && b.low_y <= a.high_y) return false;
            }
        }
        return true;
    }

private:
    static constexpr std::size_t most_outer = 64;

    std::span<const Vec3> vertices_;
    std::vector<Edge> edges_;  // ascending
    std::vector<std::uint32_t> next_;
    const unsigned axis_, x_, y_;

    const Vec3& end(std::uint32_t e) const { return vertices_[edges_[e][1]]; }
    double low(std::uint32_t e, unsigned k) const { return std::min(vertices_[edges_[e][0]][k], vertices_[edges_[e][1]][k]); }
    double high(std::uint32_t e, unsigned k) const { return std::max(vertices_[edges_[e][0]][k], vertices_[edges_[e][1]][k]); }
    double extent(unsigned k) const {
        double lowest = HUGE_VAL, highest = -HUGE_VAL;
        for (const Edge& e : edges_) {
            lowest = std::min(lowest, vertices_[e[0]][k]);
            highest = std::max(highest, vertices_[e[0]][k]);
        }
        return highest - lowest;
    }

    /// \pre the boxes around the edges meet
    bool meet(std::uint32_t e, std::uint32_t f) const {
        if (next_[e] == f) return next_[f] == e || turns_back(e, f);
        if (next_[f] == e) return turns_back(f, e);
        const Vec3 &a = vertices_[edges_[e][0]], &b = end(e), &c = vertices_[edges_[f][0]], &d = end(f);
        const auto on_one_side = [&](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
            return orientation_2d(p, q, r, axis_) * orientation_2d(p, q, s, axis_) > 0;
        };
        return !on_one_side(a, b, c, d) && !on_one_side(c, d, a, b);
    }

    /// Whether an edge runs back over the one before it.
    bool turns_back(std::uint32_t before, std::uint32_t after) const {
        const Vec3 &a = vertices_[edges_[before][0]], &b = end(before), &c = end(after);
        if (orientation_2d(a, b, c, axis_) != 0) return false;
        const auto side = [&](const Vec3& p, unsigned k) { return p[k] < b[k] ? -1 : p[k] > b[k] ? 1 : 0; };
        return side(a, x_) * side(c, x_) + side(a, y_) * side(c, y_) > 0;
    }
};

}  // namespace

bool is_single_valued(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::span<const Edge> open_edges) {
    if (triangles.empty()) return true;
    const unsigned axis = facing_axis(vertices, triangles);
    const int turn = common_turn(vertices, triangles, axis);
    std::vector<Edge> border;
    if (turn == 0 || !find_border(open_edges, border)) return false;
    BorderRings rings(vertices, std::move(border), axis);
    return rings.link() && rings.is_simple() && rings.has_outer_rings_apart(turn);
}

}  // namespace geomend
