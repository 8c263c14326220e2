// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/notches.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/vectors.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

constexpr double least_facing = 0.5;  // cosine between a triangle that fills and one beside it
constexpr std::size_t most_edges = 32;

double distance(const TriangleSoup& soup, std::uint32_t a, std::uint32_t b) {
    const Vec3 d = minus(soup.vertices[b], soup.vertices[a]);
    return std::sqrt(dot(d, d));
}

/// Signed area of a corner of a loop seen along a normal.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) { return dot(cross(minus(b, a), minus(c, b)), normal); }

/// Per vertex the ends of the edges there.
class EdgesAround {
public:
    EdgesAround(const TriangleSoup& soup, const SoupEdges& edges) : soup_(soup), edges_(edges), first_(soup.vertices.size() + 1, 0) {
        const auto each = [&](const auto& visit) {
            for (std::uint32_t e = 0; e < edges.size(); ++e) {
                visit(edges[e][0].low, e);
                visit(edges[e][0].high, e);
            }
        };
        each([&](std::uint32_t v, std::uint32_t) { ++first_[v + 1]; });
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        at_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        each([&](std::uint32_t v, std::uint32_t e) { at_[next[v]++] = e; });
    }

    /// Calls visit(other end) for the edges at a vertex that others have, and a patch on one side at most.
    template <class Visit>
    void visit_without(std::uint32_t v, std::uint32_t patch, const Visit& visit) const {
        for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
            const auto uses = edges_[at_[i]];
            const auto own = std::ranges::count_if(uses, [&](const auto& use) { return soup_.patches[use.triangle] == patch; });
            if (own > 1 || static_cast<std::size_t>(own) == uses.size()) continue;
            visit(uses[0].low == v ? uses[0].high : uses[0].low);
        }
    }

private:
    const TriangleSoup& soup_;
    const SoupEdges& edges_;
    std::vector<std::uint32_t> first_, at_;
};

/// The free edges of a patch from one point at which it ends on something else to the next.
struct Chain {
    std::vector<std::uint32_t> edges;  ///< of FreeBorders
    double length = 0;
};

std::vector<Chain> open_chains(const TriangleSoup& soup, const FreeBorders& borders, const std::vector<double>& limits) {
    std::vector<Chain> chains;
    for (std::uint32_t start = 0; start < borders.edges.size(); ++start) {
        if (borders.edges[start].previous != no_index) continue;
        Chain chain;
        const double limit = limits[soup.patches[borders.edges[start].triangle]];
        for (std::uint32_t e = start; e != no_index && chain.edges.size() <= most_edges; e = borders.edges[e].next) {
            chain.edges.push_back(e);
            chain.length += distance(soup, borders.edges[e].from, borders.edges[e].to);
        }
        if (chain.edges.size() <= 2 || (chain.edges.size() <= most_edges && chain.length < 2 * limit)) chains.push_back(std::move(chain));
    }
    return chains;
}

class NotchFinder {
public:
    NotchFinder(const TriangleSoup& soup, const SoupEdges& edges, const FreeBorders& borders, const std::vector<double>& limits)
        : soup_(soup), borders_(borders), limits_(limits), around_(soup, edges) {}

    std::optional<Notch> at(const Chain& chain) const {
        Notch notch;
        notch.source = borders_.edges[chain.edges.front()].triangle;
        notch.patch = soup_.patches[notch.source];
        for (const std::uint32_t e : chain.edges) notch.free_border.push_back(borders_.edges[e].from);
        notch.free_border.push_back(borders_.edges[chain.edges.back()].to);
        if (notch.free_border.front() == notch.free_border.back()) return std::nullopt;
        double best = least_facing;
        const auto offer_triangles = [&](std::vector<Triangle> triangles) {
            const double facing = least_cosine(triangles, chain);
            if (!(facing > best)) return;
            best = facing;
            notch.triangles = std::move(triangles);
        };
        const auto offer = [&](const std::vector<std::uint32_t>& back) {
            auto loop = notch.free_border;
            loop.insert(loop.end(), back.begin(), back.end());
            std::ranges::reverse(loop);  // on the other side of its edges
            offer_triangles(filled_loop(soup_, loop));
        };
        const std::uint32_t from = notch.free_border.back(), to = notch.free_border.front();
        if (chain.edges.size() == 2 && are_joined(from, to, notch.patch)) offer({});
        if (chain.edges.size() == 1) {
            for (const std::uint32_t corner : common_neighbours(from, to, notch.patch)) offer({corner});
        }
        if (notch.triangles.empty()) {
            if (const auto way = shortest_way(from, to, notch.patch, 2 * limits_[notch.patch] - chain.length)) offer(*way);
        }
        if (notch.triangles.empty()) offer_triangles(missing_triangle(notch));
        if (notch.triangles.empty()) return std::nullopt;
        return notch;
    }

private:
    const TriangleSoup& soup_;
    const FreeBorders& borders_;
    const std::vector<double>& limits_;
    EdgesAround around_;

    bool are_joined(std::uint32_t a, std::uint32_t b, std::uint32_t patch) const {
        bool joined = false;
        around_.visit_without(a, patch, [&](std::uint32_t end) { joined |= end == b; });
        return joined;
    }

    std::vector<std::uint32_t> common_neighbours(std::uint32_t a, std::uint32_t b, std::uint32_t patch) const {
        std::set<std::uint32_t> of_a, common;
        around_.visit_without(a, patch, [&](std::uint32_t end) { of_a.insert(end); });
        around_.visit_without(b, patch, [&](std::uint32_t end) {
            if (of_a.contains(end)) common.insert(end);
        });
        return {common.begin(), common.end()};
    }

    /// The vertices between on the shortest way along edges where the patch may go on, no longer than told.
    std::optional<std::vector<std::uint32_t>> shortest_way(std::uint32_t from, std::uint32_t to, std::uint32_t patch,
                                                           double longest) const {
        struct Reached {
            double length;
            std::uint32_t before;
        };
        std::map<std::uint32_t, Reached> reached{{from, {0, no_index}}};
        std::set<std::pair<double, std::uint32_t>> waiting{{0, from}};
        while (!waiting.empty() && waiting.begin()->second != to) {
            const auto [length, v] = *waiting.begin();
            waiting.erase(waiting.begin());
            around_.visit_without(v, patch, [&](std::uint32_t end) {
                const double there = length + distance(soup_, v, end);
                const auto known = reached.find(end);
                if (there > longest || (known != reached.end() && known->second.length <= there)) return;
                if (known != reached.end()) waiting.erase({known->second.length, end});
                reached[end] = {there, v};
                waiting.insert({there, end});
            });
        }
        if (waiting.empty()) return std::nullopt;
        std::vector<std::uint32_t> way;
        for (std::uint32_t v = reached.at(to).before; v != from && v != no_index; v = reached.at(v).before) way.push_back(v);
        std::ranges::reverse(way);
        return way;
    }

    double length_along(const std::vector<std::uint32_t>& way) const {
        double sum = 0;
        for (std::size_t i = 1; i < way.size(); ++i) sum += distance(soup_, way[i - 1], way[i]);
        return sum;
    }

    bool is_straight(const std::vector<std::uint32_t>& way) const {
        return length_along(way) <= (1 + 1e-6) * distance(soup_, way.front(), way.back());
    }

    /// What fills a single missing triangle whose neighbours have more points along its sides; empty: it is none.
    std::vector<Triangle> missing_triangle(const Notch& notch) const {
        const auto& free = notch.free_border;
        if (free.size() > 3) return {};
        constexpr double sides = 4;  // of a triangle with one free side, by that: at most
        const std::uint32_t from = free.back(), to = free.front();
        const auto between = shortest_way(from, to, notch.patch, (free.size() == 3 ? 1 + 1e-6 : sides) * distance(soup_, from, to));
        if (!between) return {};
        std::vector<std::uint32_t> way{from};
        way.insert(way.end(), between->begin(), between->end());
        way.push_back(to);
        std::vector<Triangle> triangles;
        if (free.size() == 3) {
            for (std::size_t i = 1; i < way.size(); ++i) triangles.push_back({free[1], way[i], way[i - 1]});
            return triangles;
        }
        for (std::size_t corner = 1; corner + 1 < way.size(); ++corner) {
            const auto middle = way.begin() + static_cast<std::ptrdiff_t>(corner);
            const std::vector<std::uint32_t> left(way.begin(), middle + 1),
                right(std::make_reverse_iterator(way.end()), std::make_reverse_iterator(middle));
            if (is_straight(left) && is_straight(right)) return between_sides(left, right);
        }
        return {};
    }

    /// Triangles between two ways to the same corner, the last of which alone has the corner.
    std::vector<Triangle> between_sides(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right) const {
        std::vector<Triangle> triangles;
        std::size_t i = 0, j = 0;
        while (i + 2 < left.size() || j + 2 < right.size()) {
            const bool on_left = j + 2 >= right.size() ||
                                 (i + 2 < left.size() && distance(soup_, left[i + 1], right[j]) < distance(soup_, left[i], right[j + 1]));
            triangles.push_back({right[j], on_left ? left[i + 1] : right[j + 1], left[i]});
            ++(on_left ? i : j);
        }
        triangles.push_back({right[j], left.back(), left[i]});
        return triangles;
    }

    /// Between each triangle that fills and each one beside the free border; -1 where one of them has no area.
    double least_cosine(const std::vector<Triangle>& triangles, const Chain& chain) const {
        double least = 1;
        for (const Triangle& t : triangles) {
            const Vec3 n = cross(minus(soup_.vertices[t[1]], soup_.vertices[t[0]]), minus(soup_.vertices[t[2]], soup_.vertices[t[0]]));
            for (const std::uint32_t e : chain.edges) {
                const Vec3 beside = triangle_normal(soup_, borders_.edges[e].triangle);
                const double size = std::sqrt(dot(n, n) * dot(beside, beside));
                least = std::min(least, size > 0 ? dot(n, beside) / size : -1);
            }
        }
        return least;
    }
};

}  // namespace

std::vector<Triangle> filled_loop(const TriangleSoup& soup, std::vector<std::uint32_t> loop) {
    Vec3 normal{};
    const Vec3 base = soup.vertices[loop[0]];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        normal = plus(normal, cross(minus(soup.vertices[loop[i]], base), minus(soup.vertices[loop[i + 1]], base)));
    }
    std::vector<Triangle> triangles;
    while (loop.size() > 3) {
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 &a = soup.vertices[loop[(i + loop.size() - 1) % loop.size()]], &b = soup.vertices[loop[i]],
                       &c = soup.vertices[loop[(i + 1) % loop.size()]];
            const Vec3 across = minus(c, a);
            const double cost = turn(a, b, c, normal) > 0 ? dot(across, across) : 1e30 + dot(across, across);
            if (cost >= least) continue;
            least = cost;
            best = i;
        }
        triangles.push_back({loop[(best + loop.size() - 1) % loop.size()], loop[best], loop[(best + 1) % loop.size()]});
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
    }
    triangles.push_back({loop[0], loop[1], loop[2]});
    return triangles;
}

std::vector<Notch> notches_of(const TriangleSoup& soup, const SoupEdges& edges, const FreeBorders& borders,
                              const std::vector<double>& limits) {
    std::vector<Notch> notches;
    const auto chains = open_chains(soup, borders, limits);
    if (chains.empty()) return notches;
    const NotchFinder finder(soup, edges, borders, limits);
    std::set<Triangle> there;
    for (Triangle t : soup.triangles) {
        std::ranges::sort(t);
        there.insert(t);
    }
    for (const Chain& chain : chains) {
        auto notch = finder.at(chain);
        if (!notch) continue;
        const bool is_new = std::ranges::none_of(notch->triangles, [&](Triangle t) {
            std::ranges::sort(t);
            return !there.insert(t).second;
        });
        if (is_new) notches.push_back(std::move(*notch));
    }
    return notches;
}

}  // namespace geomend::repair
