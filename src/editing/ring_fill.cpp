// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/ring_fill.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>

#include "base/length.h"
#include "base/vectors.h"

namespace geomend::editing {

namespace {

constexpr double least_facing = 0.1;  // cosine between a new triangle and the ring as a whole: it is not turned over, nor on edge

/// Of two fillings the one of whose edges fewer end at vertices that are to be taken away, too; then the one with shorter edges.
struct Cost {
    std::uint32_t ends_on_trace = 0;
    double length = 0;
    auto operator<=>(const Cost&) const = default;
    Cost operator+(const Cost& other) const { return {ends_on_trace + other.ends_on_trace, length + other.length}; }
};
constexpr Cost none{0, std::numeric_limits<double>::infinity()};
bool is_none(const Cost& cost) { return cost.length == none.length; }
bool is_better(const Cost& a, const Cost& b) { return !is_none(a) && (is_none(b) || a < b); }

/// The best filling of each part of a ring, from one place to a later one (dynamic programming).
class RingFiller {
public:
    RingFiller(const Ring& ring, const Vec3& point, const RingRules& rules, const std::function<bool(std::uint32_t, std::uint32_t)>& barred)
        : ring_(ring),
          rules_(rules),
          barred_(barred),
          n_(static_cast<std::uint32_t>(ring.places.size())),
          cost_(n_ * n_, none),
          apex_(n_ * n_, 0) {
        for (const Vec3& p : ring.places) from_point_.push_back(minus(p, point));  // what is small is not lost far from the origin
        for (std::uint32_t i = 0; i + 1 < n_; ++i) normal_ = plus(normal_, cross(from_point_[i], from_point_[i + 1]));
        if (ring.closed) normal_ = plus(normal_, cross(from_point_[n_ - 1], from_point_[0]));
    }

    bool folds() const {
        const double all = dot(normal_, normal_);
        if (!(all > 0)) return true;
        for (std::uint32_t i = 0; i < n_ - (ring_.closed ? 0 : 1); ++i) {
            if (dot(cross(from_point_[i], from_point_[(i + 1) % n_]), normal_) < -1e-9 * all) return true;
        }
        return false;
    }

    bool fill() {
        for (std::uint32_t i = 0; i + 1 < n_; ++i) cost_[at(i, i + 1)] = {};
        for (std::uint32_t width = 2; width < n_; ++width) {
            for (std::uint32_t i = 0; i + width < n_; ++i) fill_part(i, i + width);
        }
        return !is_none(cost_[at(0, n_ - 1)]);
    }

    std::vector<std::array<std::uint32_t, 3>> triangles() const {
        std::vector<std::array<std::uint32_t, 3>> all;
        std::vector<std::array<std::uint32_t, 2>> parts{{0, n_ - 1}};
        while (!parts.empty()) {
            const auto [i, j] = parts.back();
            parts.pop_back();
            if (j < i + 2) continue;
            const std::uint32_t k = apex_[at(i, j)];
            all.push_back({i, k, j});
            parts.push_back({i, k});
            parts.push_back({k, j});
        }
        return all;
    }

private:
    std::size_t at(std::uint32_t i, std::uint32_t j) const { return std::size_t{i} * n_ + j; }

    /// What the edge from i to j costs: nothing where it is there already, on the ring.
    Cost edge_cost(std::uint32_t i, std::uint32_t j) const {
        if (i == 0 && j + 1 == n_) return !ring_.closed && barred_(i, j) ? none : Cost{};
        if (barred_(i, j)) return none;
        const std::uint32_t ends = (ring_.on_trace[i] != 0 ? 1u : 0u) + (ring_.on_trace[j] != 0 ? 1u : 0u);
        return {ends, length(minus(from_point_[j], from_point_[i]))};
    }

    bool allowed(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
        const Vec3 &a = from_point_[i], &b = from_point_[k], &c = from_point_[j];
        const Vec3 n = cross(minus(b, a), minus(c, a));
        const double area = length(n);
        if (!(area > 0) || dot(n, normal_) < least_facing * area * length(normal_)) return false;
        const double longest = std::max({length(minus(b, a)), length(minus(c, b)), length(minus(a, c))});
        return area >= rules_.flatness * longest && std::abs(dot(n, a)) <= rules_.distance * area;
    }

    void fill_part(std::uint32_t i, std::uint32_t j) {
        const Cost edge = edge_cost(i, j);
        if (is_none(edge)) return;
        for (std::uint32_t k = i + 1; k < j; ++k) {
            const Cost cost = edge + cost_[at(i, k)] + cost_[at(k, j)];
            if (!is_better(cost, cost_[at(i, j)]) || !allowed(i, k, j)) continue;
            cost_[at(i, j)] = cost;
            apex_[at(i, j)] = k;
        }
    }

    const Ring& ring_;
    const RingRules& rules_;
    const std::function<bool(std::uint32_t, std::uint32_t)>& barred_;
    std::uint32_t n_;
    std::vector<Vec3> from_point_;
    Vec3 normal_{};
    std::vector<Cost> cost_;
    std::vector<std::uint32_t> apex_;
};

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> fill_ring(const Ring& ring, const Vec3& point, const RingRules& rules,
                                                                   const std::function<bool(std::uint32_t, std::uint32_t)>& barred) {
    RingFiller filler(ring, point, rules, barred);
    if (filler.folds() || !filler.fill()) return std::nullopt;
    return filler.triangles();
}

}  // namespace geomend::editing
