// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/chains.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace geomend::gridding {

namespace {

constexpr double corridor = 2.5;        // cells
constexpr double cost_of_sharing = 50;  // times the length of the edge

struct Level {
    const Net& net;
    std::vector<Point> at;  // per pillar
    Path outline;
    double cell;
};

/// The pillars near a trace, with a number of their own each.
struct Corridor {
    std::vector<std::uint32_t> pillars;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
};

Corridor corridor_of(const Level& level, const Path& trace, double width) {
    Point low = trace[0], high = trace[0];
    for (const Point& p : trace) {
        for (std::size_t a = 0; a < 2; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    Corridor found;
    for (std::uint32_t p = 0; p < level.at.size(); ++p) {
        const Point& q = level.at[p];
        if (q[0] < low[0] - width || q[0] > high[0] + width || q[1] < low[1] - width || q[1] > high[1] + width) continue;
        if (nearest_on(trace, q).distance > width) continue;
        found.numbers.emplace(p, static_cast<std::uint32_t>(found.pillars.size()));
        found.pillars.push_back(p);
    }
    return found;
}

/// The edge between two neighbouring pillars.
std::int32_t& edge_between(const Net& net, ChainEdges& edges, std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = std::min(a, b), row = net.cells[0] + 1;
    if (std::max(a, b) - first == 1) return edges.along_i[first % row + std::size_t{net.cells[0]} * (first / row)];
    return edges.along_j[first];
}

template <class Visit>
void visit_neighbours(const Net& net, std::uint32_t p, const Visit& visit) {
    const std::uint32_t row = net.cells[0] + 1, i = p % row, j = p / row;
    if (i > 0) visit(p - 1);
    if (i < net.cells[0]) visit(p + 1);
    if (j > 0) visit(p - row);
    if (j < net.cells[1]) visit(p + row);
}

/// The pillar nearest to a point of those that count; the lowest number where several are as near.
template <class Counts>
std::uint32_t nearest_pillar(const Level& level, const std::vector<std::uint32_t>& pillars, const Point& p, const Counts& counts) {
    std::uint32_t best = no_index;
    double least = 1e300;
    for (const std::uint32_t q : pillars) {
        if (!counts(q)) continue;
        const double d = distance(level.at[q], p);
        if (best == no_index || d < least * (1 - 1e-12)) {
            least = std::min(least, d);
            best = q;
        }
    }
    return best;
}

/// The shortest path between two pillars within a corridor; empty where there is none.
std::vector<std::uint32_t> shortest_path(const Level& level, const Corridor& near, const Path& trace, std::uint32_t from, std::uint32_t to,
                                         ChainEdges& edges, const std::array<std::int32_t, 2>& mains) {
    struct State {
        double cost = 1e300;
        std::uint32_t before = no_index;
        bool done = false;
    };
    std::vector<State> states(near.pillars.size());
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    states[near.numbers.at(from)].cost = 0;
    queue.emplace(0.0, from);
    while (!queue.empty()) {
        const auto [cost, p] = queue.top();
        queue.pop();
        State& state = states[near.numbers.at(p)];
        if (state.done) continue;
        state.done = true;
        if (p == to) break;
        visit_neighbours(level.net, p, [&](std::uint32_t q) {
            const auto number = near.numbers.find(q);
            if (number == near.numbers.end()) return;
            const Point &a = level.at[p], &b = level.at[q];
            const double d = nearest_on(trace, {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}).distance / level.cell;
            double more = distance(a, b) * (1 + d * d);
            const std::int32_t taken = edge_between(level.net, edges, p, q);
            if (taken != ChainEdges::no_fault && taken != mains[0] && taken != mains[1]) more += distance(a, b) * cost_of_sharing;
            State& next = states[number->second];
            if (cost + more >= next.cost) return;
            next.cost = cost + more;
            next.before = p;
            queue.emplace(next.cost, q);
        });
    }
    std::vector<std::uint32_t> path;
    if (!states[near.numbers.at(to)].done) return path;
    for (std::uint32_t p = to; p != no_index; p = states[near.numbers.at(p)].before) path.push_back(p);
    std::ranges::reverse(path);
    return path;
}

/// How far the chain is from its trace: exact where the distance changes evenly along an eighth of an edge.
void measure(const Level& level, Chain& chain) {
    constexpr int pieces = 8;
    double sum = 0, all = 0;
    for (std::size_t k = 1; k < chain.pillars.size(); ++k) {
        const Point &a = level.at[chain.pillars[k - 1]], &b = level.at[chain.pillars[k]];
        const double l = distance(a, b) / pieces;
        for (int s = 0; s <= pieces; ++s) {
            const double t = static_cast<double>(s) / pieces;
            const double d = nearest_on(chain.trace, {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}).distance;
            chain.max_deviation = std::max(chain.max_deviation, d);
            sum += d * l * (s == 0 || s == pieces ? 0.5 : 1);
        }
        all += l * pieces;
    }
    chain.mean_deviation = all > 0 ? sum / all : 0;
}

struct End {
    std::uint32_t on = no_index;  // the fault on whose trace it lies
    Point where{};
    bool on_outline = false;
};

/// Where each end of a trace lies.
std::array<End, 2> ends_of(const Level& level, const std::vector<Path>& inside, std::size_t f) {
    std::array<End, 2> ends;
    const Path& trace = inside[f];
    for (std::size_t e = 0; e < 2; ++e) {
        const Point& p = e == 0 ? trace.front() : trace.back();
        ends[e].where = p;
        double least = 0.5 * level.cell;
        for (std::uint32_t g = 0; g < inside.size(); ++g) {
            if (g == f || inside[g].empty()) continue;
            const OnPath near = nearest_on(inside[g], p);
            if (near.distance >= least) continue;
            least = near.distance;
            ends[e].on = g;
            ends[e].where = near.at;
        }
        Path closed = level.outline;
        closed.push_back(closed.front());
        if (ends[e].on == no_index && nearest_on(closed, p).distance < 0.5 * level.cell) ends[e].on_outline = true;
    }
    return ends;
}

/// The order in which chains are made: those on which others end before these, else the longest first.
std::vector<std::uint32_t> order_of(const std::vector<Path>& inside, const std::vector<std::array<End, 2>>& ends) {
    std::vector<std::uint32_t> left(inside.size()), order;
    for (std::uint32_t f = 0; f < left.size(); ++f) left[f] = f;
    std::ranges::stable_sort(left, std::greater{}, [&](std::uint32_t f) { return length(inside[f]); });
    while (!left.empty()) {
        const auto is_free = [&](std::uint32_t f) {
            return std::ranges::none_of(ends[f], [&](const End& e) { return std::ranges::find(left, e.on) != left.end(); });
        };
        auto next = std::ranges::find_if(left, is_free);
        if (next == left.end()) next = left.begin();
        order.push_back(*next);
        left.erase(next);
    }
    return order;
}

class Maker {
public:
    Maker(const Level& level, Chains& made) : level_(level), made_(made) {}

    void make(std::uint32_t f, const Path& trace, const std::array<End, 2>& ends) {
        Chain& chain = made_.chains[f];
        chain.trace = trace;
        const Corridor near = corridor_of(level_, trace, corridor * level_.cell);
        if (near.pillars.empty()) {
            chain.why_not = "no pillar is near it";
            return;
        }
        const std::uint32_t from = end_pillar(near, f, ends[0], no_index);
        std::uint32_t to = end_pillar(near, f, ends[1], no_index);
        if (from == to && length(trace) > 0.5 * level_.cell) to = end_pillar(near, f, ends[1], from);
        if (from == to || from == no_index || to == no_index) {
            chain.why_not = "it is shorter than a cell";
            return;
        }
        const std::array<std::int32_t, 2> mains{main_of(ends[0]), main_of(ends[1])};
        chain.pillars = shortest_path(level_, near, trace, from, to, made_.edges, mains);
        end_at_first_contact(chain.pillars, mains);
        if (chain.pillars.empty()) chain.why_not = "no way along it leads through the grid";
        take_edges(f);
        measure(level_, chain);
    }

private:
    const Level& level_;
    Chains& made_;

    std::uint32_t end_pillar(const Corridor& near, std::uint32_t f, const End& end, std::uint32_t not_this) {
        if (end.on != no_index && !made_.chains[end.on].pillars.empty()) {
            const auto& main = made_.chains[end.on].pillars;
            const auto p =
                nearest_pillar(level_, main, end.where, [&](std::uint32_t q) { return q != not_this && near.numbers.contains(q); });
            if (p != no_index) {
                auto& on = made_.chains[f].ends_on;
                if (std::ranges::find(on, end.on) == on.end()) on.push_back(end.on);
                return p;
            }
        }
        return nearest_pillar(level_, near.pillars, end.where,
                              [&](std::uint32_t q) { return q != not_this && (!end.on_outline || level_.net.is_outermost(q)); });
    }

    static std::int32_t main_of(const End& end) { return end.on == no_index ? ChainEdges::no_fault : static_cast<std::int32_t>(end.on); }

    /// A branch that comes to its main fault at a small angle ends where it reaches that one's chain: what would go on along it is cut off.
    void end_at_first_contact(std::vector<std::uint32_t>& path, const std::array<std::int32_t, 2>& mains) {
        const auto lies_on = [&](std::uint32_t a, std::uint32_t b, std::int32_t main) {
            return main != ChainEdges::no_fault && edge_between(level_.net, made_.edges, a, b) == main;
        };
        while (path.size() > 2 && lies_on(path[0], path[1], mains[0])) path.erase(path.begin());
        while (path.size() > 2 && lies_on(path[path.size() - 2], path.back(), mains[1])) path.pop_back();
    }

    void take_edges(std::uint32_t f) {
        Chain& chain = made_.chains[f];
        for (std::size_t k = 1; k < chain.pillars.size(); ++k) {
            std::int32_t& edge = edge_between(level_.net, made_.edges, chain.pillars[k - 1], chain.pillars[k]);
            if (edge == ChainEdges::no_fault) edge = static_cast<std::int32_t>(f);
            else ++chain.shared_edges;
        }
    }
};

}  // namespace

Chains make_chains(const Net& net, const std::vector<Path>& traces, double depth) {
    Chains made;
    made.chains.resize(traces.size());
    made.edges.along_i.assign(std::size_t{net.cells[0]} * (net.cells[1] + std::size_t{1}), ChainEdges::no_fault);
    made.edges.along_j.assign((std::size_t{net.cells[0]} + 1) * net.cells[1], ChainEdges::no_fault);
    if (traces.empty()) return made;
    Level level{net, std::vector<Point>(net.pillar_count()), outline_of(net, depth), spacing_of(net, depth)};
    for (std::size_t p = 0; p < level.at.size(); ++p) level.at[p] = net.at(p, depth);

    std::vector<Path> inside(traces.size());
    for (std::size_t f = 0; f < traces.size(); ++f) {
        if (traces[f].size() > 1) inside[f] = longest_inside(traces[f], level.outline);
        if (inside[f].empty()) made.chains[f].why_not = traces[f].size() < 2 ? "it has no trace" : "it lies outside of the grid";
    }
    std::vector<std::array<End, 2>> ends(traces.size());
    for (std::size_t f = 0; f < traces.size(); ++f) {
        if (!inside[f].empty()) ends[f] = ends_of(level, inside, f);
    }
    Maker maker(level, made);
    for (const std::uint32_t f : order_of(inside, ends)) {
        if (!inside[f].empty()) maker.make(f, inside[f], ends[f]);
    }
    return made;
}

}  // namespace geomend::gridding
