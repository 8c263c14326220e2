// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/free_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/place_words.h"
#include "base/wording.h"
#include "geometry/vectors.h"

namespace geomend::validators {

namespace {

void measure(const BrepData& brep, FreeBorder& border) {
    Vec3 sum{};
    for (const std::uint32_t l : border.lines) {
        const auto& line = brep.lines[l];
        for (std::size_t i = 1; i < line.vertices.size(); ++i) {
            const Vec3 &a = brep.vertices[line.vertices[i - 1].value], &b = brep.vertices[line.vertices[i].value];
            const Vec3 way = minus(b, a);
            const double length = std::sqrt(dot(way, way));
            border.length += length;
            ++border.edges;
            sum = plus(sum, times(length / 2, plus(a, b)));
        }
    }
    if (border.length > 0) border.middle = times(1 / border.length, sum);
}

/// Goes along the edges of a border from one to the next; false where they branch or end.
bool go_round(const BrepData& brep, const FreeBorder& border, std::vector<std::uint32_t>& way) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> next;  // per vertex
    for (const std::uint32_t l : border.lines) {
        const auto& v = brep.lines[l].vertices;
        for (std::size_t i = 1; i < v.size(); ++i) {
            next[v[i - 1].value].push_back(v[i].value);
            next[v[i].value].push_back(v[i - 1].value);
        }
    }
    if (std::ranges::any_of(next, [](const auto& at) { return at.second.size() != 2; })) return false;
    std::uint32_t here = next.begin()->first, before = no_index;
    do {
        way.push_back(here);
        const auto& both = next[here];
        const std::uint32_t to = both[0] == before ? both[1] : both[0];
        before = here;
        here = to;
    } while (here != way.front() && way.size() <= next.size());
    return way.size() == next.size();
}

void face(const BrepData& brep, FreeBorder& border) {
    std::vector<std::uint32_t> way;
    border.closed = go_round(brep, border, way);
    if (!border.closed) return;
    for (std::size_t i = 0; i < way.size(); ++i) {
        const Vec3 a = minus(brep.vertices[way[i]], border.middle), b = minus(brep.vertices[way[(i + 1) % way.size()]], border.middle);
        border.facing = plus(border.facing, times(0.5, cross(a, b)));
    }
}

/// Free lines that hang together as rings, each of which goes round once: holes may touch in a point. All in one where lines end or
/// branch so that there are no such rings.
std::vector<std::vector<std::uint32_t>> rings_of(const BrepData& brep, const std::vector<std::uint32_t>& lines) {
    std::vector<std::vector<std::uint32_t>> rings;
    std::map<std::uint32_t, std::vector<std::uint32_t>> open_at;  // per vertex the lines that end there and are in no ring
    const auto ends = [&](std::uint32_t l) {
        const auto& v = brep.lines[l].vertices;
        return std::array{v.front().value, v.back().value};
    };
    for (const std::uint32_t l : lines) {
        const auto [a, b] = ends(l);
        if (a == b) rings.push_back({l});
        else open_at[a].push_back(l), open_at[b].push_back(l);
    }
    if (std::ranges::any_of(open_at, [](const auto& at) { return at.second.size() % 2 != 0; })) return {lines};
    for (const auto& [start, unused] : open_at) {
        std::vector<std::uint32_t> way, stations{start};  // lines, and the vertices before and behind them
        while (!way.empty() || !open_at[stations.back()].empty()) {
            const std::uint32_t here = stations.back(), l = open_at[here].back();
            const auto [a, b] = ends(l);
            const std::uint32_t there = a == here ? b : a;
            std::erase(open_at[here], l);
            std::erase(open_at[there], l);
            way.push_back(l);
            const auto again = std::ranges::find(stations, there);
            const auto first = again - stations.begin();
            if (again == stations.end()) {
                stations.push_back(there);
                continue;
            }
            rings.emplace_back(way.begin() + first, way.end());
            way.resize(static_cast<std::size_t>(first));
            stations.resize(static_cast<std::size_t>(first) + 1);
        }
    }
    return rings;
}

}  // namespace

std::vector<FreeBorder> free_borders(const ModelScope& scope, std::span<const std::uint32_t> lines) {
    const BrepData& brep = scope.brep();
    std::map<std::uint32_t, std::uint32_t> at_corner;  // a line that ends there
    std::vector<std::uint32_t> free;
    for (const std::uint32_t l : lines) {
        if (scope.free_lines()[l] != 0) free.push_back(l);
    }
    std::ranges::sort(free);
    free.erase(std::unique(free.begin(), free.end()), free.end());
    DisjointSets joined(free.size());
    for (std::uint32_t i = 0; i < free.size(); ++i) {
        for (const CornerId c : brep.lines[free[i]].corners) joined.join(i, at_corner.emplace(c.value, i).first->second);
    }
    const topology::LineGraph& graph = scope.model().graph;
    const auto surface_at = [&](std::uint32_t l) {
        const auto uses = graph.edge_uses(graph.edges[graph.line_edges[graph.line_first_edge[l]]]);
        const auto of_surface = std::ranges::find_if(uses, [](const auto& use) { return use.surface != no_index; });
        return of_surface == uses.end() ? no_index : of_surface->surface;
    };
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
    for (std::uint32_t i = 0; i < free.size(); ++i) by_root[joined.root(i)].push_back(free[i]);
    std::vector<FreeBorder> borders;
    for (const auto& [root, together] : by_root) {
        const bool of_one = std::ranges::all_of(together, [&](std::uint32_t l) { return surface_at(l) == surface_at(together[0]); });
        auto rings = of_one ? rings_of(brep, together) : std::vector<std::vector<std::uint32_t>>{together};
        for (auto& ring : rings) {
            FreeBorder border;
            border.lines = std::move(ring);
            measure(brep, border);
            face(brep, border);
            borders.push_back(std::move(border));
        }
    }
    std::ranges::stable_sort(borders, {}, &FreeBorder::length);
    return borders;
}

std::string border_text(const ModelScope& scope, std::span<const FreeBorder> borders) {
    if (borders.empty()) return {};
    const FreeBorder& first = borders.front();
    const bool is_depth = scope.brep().crs.z_positive == ZPositive::depth;
    std::string text = counted(first.edges, "edge", "edges") + ", " + rounded(first.length) + " long, around " +
                       place_words({first.middle[0], first.middle[1], is_depth ? 0.0 - first.middle[2] : first.middle[2]});
    if (borders.size() > 1) text += ", and " + counted(borders.size() - 1, "more", "more");
    return text;
}

void mark_borders(const ModelScope& scope, std::span<const FreeBorder> borders, Finding& finding) {
    std::uint64_t edges = 0;
    double length = 0;
    for (const FreeBorder& border : borders) {
        edges += border.edges;
        length += border.length;
        for (const std::uint32_t l : border.lines) mark_line(scope, l, finding);
    }
    finding.measures.emplace_back("edges", static_cast<double>(edges));
    finding.measures.emplace_back("length", length);
}

std::vector<std::uint32_t> surface_groups(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    DisjointSets groups(brep.surfaces.size());
    std::vector<std::uint32_t> first(brep.lines.size(), no_index);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const auto& use : brep.surfaces[s].lines) {
            std::uint32_t& owner = first[use.line.value];
            if (owner == no_index) owner = s;
            groups.join(owner, s);
        }
    }
    return std::move(groups).roots();
}

std::vector<std::uint8_t> closing_groups(const ModelScope& scope) {
    const auto& side = scope.model().found.region_of_side;
    const auto groups = surface_groups(scope);
    std::vector<std::uint8_t> closes(groups.size(), 0);
    for (std::size_t s = 0; s < groups.size() && !side.empty(); ++s) {
        if (side[2 * s] != side[2 * s + 1]) closes[groups[s]] = 1;
    }
    for (std::size_t s = 0; s < groups.size(); ++s) closes[s] = closes[groups[s]];  // roots come first
    return closes;
}

}  // namespace geomend::validators
