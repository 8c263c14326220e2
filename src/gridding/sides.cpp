// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/sides.h"

#include <algorithm>
#include <cmath>

#include "geometry/closest_points.h"
#include "geometry/vectors.h"

namespace geomend::gridding {

namespace {

constexpr std::int8_t unseen = 2;

/// The quadrant of a pillar that a column is in, seen from there; 4 where the column is not in the grid.
unsigned quadrant_of(const Net& net, std::uint32_t pillar, std::ptrdiff_t column_i, std::ptrdiff_t column_j) {
    if (column_i < 0 || column_j < 0 || column_i >= net.cells[0] || column_j >= net.cells[1]) return 4;
    const std::ptrdiff_t row = net.cells[0] + std::ptrdiff_t{1}, i = pillar % row, j = pillar / row;
    return static_cast<unsigned>((column_i - i + 1) + 2 * (column_j - j + 1));
}

/// The nodes on both sides of a chain.
class Seeds {
public:
    Seeds(const Net& net, const SplitPillars& split, bool left_is_j_plus, std::vector<std::int8_t>& sides)
        : net_(net), split_(split), turn_(left_is_j_plus ? 1 : -1), sides_(sides) {}

    void add(std::uint32_t from, std::uint32_t to) {
        const std::ptrdiff_t row = net_.cells[0] + std::ptrdiff_t{1}, first = std::min(from, to), i = first % row, j = first / row;
        const bool along_i = std::max(from, to) - static_cast<std::uint32_t>(first) == 1;
        const int ahead = from < to ? 1 : -1;
        // Along I the columns beside the edge are (i,j) towards J+ and (i,j-1); along J (i-1,j) towards I- and (i,j).
        const std::array<std::ptrdiff_t, 2> left = along_i ? std::array{i, j} : std::array{i - 1, j};
        const std::array<std::ptrdiff_t, 2> right = along_i ? std::array{i, j - 1} : std::array{i, j};
        for (const std::uint32_t p : {from, to}) {
            mark(p, left, static_cast<std::int8_t>(ahead * turn_));
            mark(p, right, static_cast<std::int8_t>(-ahead * turn_));
        }
    }
    const std::vector<std::uint32_t>& nodes() const { return nodes_; }

private:
    const Net& net_;
    const SplitPillars& split_;
    int turn_;
    std::vector<std::int8_t>& sides_;
    std::vector<std::uint32_t> nodes_;

    void mark(std::uint32_t pillar, const std::array<std::ptrdiff_t, 2>& column, std::int8_t side) {
        const unsigned q = quadrant_of(net_, pillar, column[0], column[1]);
        if (q > 3) return;
        const std::uint32_t node = split_.node(pillar, q);
        if (sides_[node] == unseen) {
            sides_[node] = side;
            nodes_.push_back(node);
        } else if (sides_[node] != side) sides_[node] = 0;
    }
};

}  // namespace

NearFaults near_faults(const Net& net, const SplitPillars& split, const NodeGraph& graph, const Chains& chains,
                       std::span<const double> reach, double depth) {
    const bool left_is_j_plus = area_of(outline_of(net, depth)) > 0;
    std::vector<std::vector<NearFault>> lists(split.node_count());
    std::vector<std::int8_t> sides(split.node_count(), unseen);
    for (std::uint32_t f = 0; f < chains.chains.size(); ++f) {
        const Chain& chain = chains.chains[f];
        if (chain.pillars.empty()) continue;
        Seeds seeds(net, split, left_is_j_plus, sides);
        for (std::size_t k = 1; k < chain.pillars.size(); ++k) seeds.add(chain.pillars[k - 1], chain.pillars[k]);
        // What is reached from a tip first lies on no side.
        std::vector<std::uint32_t> queue = seeds.nodes();
        std::ranges::stable_partition(queue, [&](std::uint32_t node) { return sides[node] == 0; });
        for (std::size_t k = 0; k < queue.size(); ++k) {
            const std::uint32_t node = queue[k];
            lists[node].push_back({f, sides[node]});
            for (const std::uint32_t next : graph.of(node)) {
                if (sides[next] != unseen) continue;
                if (nearest_on(chain.trace, net.at(split.pillar_of[next], depth)).distance > reach[f]) continue;
                sides[next] = sides[node];
                queue.push_back(next);
            }
        }
        for (const std::uint32_t node : queue) sides[node] = unseen;
    }
    NearFaults near;
    near.first.reserve(lists.size() + 1);
    near.first.push_back(0);
    for (const auto& list : lists) {
        near.all.insert(near.all.end(), list.begin(), list.end());
        near.first.push_back(near.all.size());
    }
    return near;
}

FaultSides::FaultSides(const Fault& fault) : fault_(fault) {
    for (const Path& polygon : fault.polygons) {
        Ring ring{polygon, {1e300, 1e300}, {-1e300, -1e300}};
        for (const Point& p : polygon) {
            for (std::size_t a = 0; a < 2; ++a) {
                ring.low[a] = std::min(ring.low[a], p[a]);
                ring.high[a] = std::max(ring.high[a], p[a]);
            }
        }
        rings_.push_back(std::move(ring));
    }
    for (Path trace : fault.traces) {
        if (trace.size() > 1 && fault.trace.size() > 1) {
            const OnPath first = nearest_on(fault.trace, trace.front()), last = nearest_on(fault.trace, trace.back());
            if (first.along > last.along) std::ranges::reverse(trace);
        }
        traces_.push_back(std::move(trace));
    }
    if (fault.sheet.triangles.empty()) return;
    for (const Triangle& t : fault.sheet.triangles) {
        const Vec3 n = cross(minus(fault.sheet.vertices[t[1]], fault.sheet.vertices[t[0]]),
                             minus(fault.sheet.vertices[t[2]], fault.sheet.vertices[t[0]]));
        const double l = std::sqrt(dot(n, n));
        normals_.push_back(l > 0 ? times(1 / l, n) : Vec3{});
    }
    tree_.emplace(fault.sheet.vertices, fault.sheet.triangles);
}

int FaultSides::side(std::size_t horizon, const Vec3& p) const {
    if (fault_.trace.size() < 2) return 0;
    if (tree_) return side_of_sheet(p);
    const Path& trace = horizon < traces_.size() && !traces_[horizon].empty() ? traces_[horizon] : fault_.trace;
    if (trace.size() < 2) return 0;
    const OnPath near = nearest_on(trace, {p[0], p[1]});
    if ((near.before_first && !goes_on_[0]) || (near.after_last && !goes_on_[1]) || near.left == 0) return 0;
    return near.left > 0 ? 1 : -1;
}

int FaultSides::side_of_sheet(const Vec3& p) const {
    // The nearest triangle, looked for in boxes that grow until it lies within them.
    double reach = 0;
    for (const Vec3& v : {fault_.sheet.vertices[fault_.sheet.triangles[0][0]]}) reach = std::sqrt(dot(minus(v, p), minus(v, p)));
    const double all = reach;
    for (reach = all / 64;; reach *= 4) {
        Closest best;
        best.distance = 1e300;
        std::uint32_t triangle = no_index;
        tree_->visit_triangles(tree_->box(p, p, reach), [&](std::size_t i) {
            const Triangle& t = tree_->triangle(i);
            const auto& v = fault_.sheet.vertices;
            const Closest near = closest_points(p, {v[t[0]], v[t[1]], v[t[2]]});
            if (near.distance < best.distance || (near.distance == best.distance && tree_->number(i) < triangle)) {
                best = near;
                triangle = tree_->number(i);
            }
        });
        if (best.distance > reach && reach < all) continue;
        if (triangle == no_index || best.distance <= 1e-9 * (1 + all)) return 0;
        const Vec3 away = times(-1 / best.distance, best.apart);
        if (std::abs(dot(away, normals_[triangle])) < 0.3) return 0;  // beyond the border of the fault
        const OnPath on = nearest_on(fault_.trace, {best.on_second[0], best.on_second[1]});
        const Point &a = fault_.trace[on.segment], &b = fault_.trace[on.segment + 1];
        const double left = (b[0] - a[0]) * away[1] - (b[1] - a[1]) * away[0];
        return left == 0 ? 0 : left > 0 ? 1 : -1;
    }
}

bool FaultSides::is_torn(std::size_t horizon, const Point& p) const {
    if (horizon >= rings_.size() || rings_[horizon].points.empty()) return false;
    const Ring& ring = rings_[horizon];
    if (p[0] < ring.low[0] || p[1] < ring.low[1] || p[0] > ring.high[0] || p[1] > ring.high[1]) return false;
    return is_inside(ring.points, p);
}

double FaultSides::reach(double upper, double lower) const {
    double most = 0;
    if (fault_.trace.size() < 2) return most;
    for (const auto& ring : rings_) {
        for (const Point& p : ring.points) most = std::max(most, nearest_on(fault_.trace, p).distance);
    }
    for (const Triangle& t : fault_.sheet.triangles) {
        for (const std::uint32_t v : t) {
            const Vec3& p = fault_.sheet.vertices[v];
            if (p[2] >= upper && p[2] <= lower) {
                const OnPath near = nearest_on(fault_.trace, {p[0], p[1]});
                if (!near.before_first && !near.after_last) most = std::max(most, near.distance);
            }
        }
    }
    return most;
}

}  // namespace geomend::gridding
