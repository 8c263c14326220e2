// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/fault_trace.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace geomend::gridding {

namespace {

/// The two points of a ring that are farthest from each other.
std::array<std::size_t, 2> tips_of(const Path& ring) {
    std::array<std::size_t, 2> tips{0, 0};
    double most = -1;
    for (std::size_t a = 0; a < ring.size(); ++a) {
        for (std::size_t b = a + 1; b < ring.size(); ++b) {
            const double d = distance(ring[a], ring[b]);
            if (d > most) {
                most = d;
                tips = {a, b};
            }
        }
    }
    return tips;
}

/// The points of a line at which the other line is nearest to it, by shares of length.
double share_of(const Path& line, double along) {
    const double all = length(line);
    return all > 0 ? along / all : 0;
}

/// The ends that two edges of triangles share are the same corner of the level line: an edge of two vertices, the lower number first.
using EdgeKey = std::array<std::uint32_t, 2>;

struct LevelGraph {
    std::map<EdgeKey, std::uint32_t> numbers;
    Path points;
    std::vector<std::vector<std::uint32_t>> next;

    std::uint32_t node(const Sheet& sheet, std::uint32_t a, std::uint32_t b, double depth) {
        const EdgeKey key{std::min(a, b), std::max(a, b)};
        const auto [at, is_new] = numbers.try_emplace(key, static_cast<std::uint32_t>(points.size()));
        if (is_new) {
            const Vec3 &p = sheet.vertices[key[0]], &q = sheet.vertices[key[1]];
            const double t = (depth - p[2]) / (q[2] - p[2]);
            points.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
            next.emplace_back();
        }
        return at->second;
    }
};

LevelGraph level_graph(const Sheet& sheet, double depth) {
    LevelGraph graph;
    for (const Triangle& t : sheet.triangles) {
        std::array<std::uint32_t, 3> found{};
        std::size_t n = 0;
        for (std::size_t e = 0; e < 3; ++e) {
            const std::uint32_t a = t[e], b = t[(e + 1) % 3];
            // A vertex on the level counts as below it, so that each triangle has no or two crossings.
            if ((sheet.vertices[a][2] < depth) != (sheet.vertices[b][2] < depth)) found[n++] = graph.node(sheet, a, b, depth);
        }
        if (n != 2 || found[0] == found[1]) continue;
        graph.next[found[0]].push_back(found[1]);
        graph.next[found[1]].push_back(found[0]);
    }
    return graph;
}

/// Follows the graph from a node along edges that were not gone yet.
Path walk(LevelGraph& graph, std::uint32_t from) {
    Path path{graph.points[from]};
    while (!graph.next[from].empty()) {
        const std::uint32_t to = graph.next[from].back();
        graph.next[from].pop_back();
        std::erase(graph.next[to], from);
        path.push_back(graph.points[to]);
        from = to;
    }
    return path;
}

/// Joins lines whose ends are near each other compared with their lengths, until none are; the longest one is left.
Path joined(std::vector<Path> lines) {
    std::ranges::stable_sort(lines, std::greater{}, [](const Path& p) { return length(p); });
    if (lines.empty()) return {};
    Path all = std::move(lines.front());
    for (bool grew = true; grew;) {
        grew = false;
        for (std::size_t i = 1; i < lines.size() && !grew; ++i) {
            Path& more = lines[i];
            const double near = 0.02 * (length(all) + length(more));
            if (more.size() < 2) continue;
            if (distance(all.back(), more.back()) < near || distance(all.front(), more.back()) < near) std::ranges::reverse(more);
            if (distance(all.back(), more.front()) < near) all.insert(all.end(), more.begin(), more.end());
            else if (distance(all.front(), more.front()) < near) {
                std::ranges::reverse(more);
                all.insert(all.begin(), more.begin(), more.end());
            } else continue;
            more.clear();
            grew = true;
        }
    }
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace

Path centreline(const Path& ring) {
    const auto tips = tips_of(ring);
    Path one(ring.begin() + static_cast<std::ptrdiff_t>(tips[0]), ring.begin() + static_cast<std::ptrdiff_t>(tips[1]) + 1);
    Path other(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(tips[0]) + 1);
    std::ranges::reverse(other);
    Path rest(ring.begin() + static_cast<std::ptrdiff_t>(tips[1]), ring.end());
    std::ranges::reverse(rest);
    other.insert(other.end(), rest.begin(), rest.end());
    // Midway between each point of one side and the nearest place of the other one, in the order of their shares of length.
    std::vector<std::pair<double, Point>> middles;
    const auto add = [&](const Path& from, const Path& to) {
        double along = 0;
        for (std::size_t i = 1; i + 1 < from.size(); ++i) {
            along += distance(from[i - 1], from[i]);
            const OnPath near = nearest_on(to, from[i]);
            middles.emplace_back((share_of(from, along) + share_of(to, near.along)) / 2,
                                 Point{(from[i][0] + near.at[0]) / 2, (from[i][1] + near.at[1]) / 2});
        }
    };
    add(one, other);
    add(other, one);
    std::ranges::stable_sort(middles, {}, [](const auto& m) { return m.first; });
    Path line{ring[tips[0]]};
    const Point last = ring[tips[1]];
    for (const auto& [share, p] : middles) {
        // Points that would lead the line back are left out.
        if (line.size() > 1) {
            const Point &a = line[line.size() - 2], &b = line.back();
            if ((b[0] - a[0]) * (p[0] - b[0]) + (b[1] - a[1]) * (p[1] - b[1]) <= 0) continue;
        }
        if (distance(line.back(), p) > 0 && distance(p, last) > 0) line.push_back(p);
    }
    line.push_back(last);
    return line;
}

Path level_line(const Sheet& sheet, double depth) {
    LevelGraph graph = level_graph(sheet, depth);
    std::vector<Path> lines;
    for (const bool from_ends : {true, false}) {
        for (std::uint32_t n = 0; n < graph.points.size(); ++n) {
            if (from_ends && graph.next[n].size() != 1) continue;
            if (!graph.next[n].empty()) lines.push_back(walk(graph, n));
        }
    }
    return joined(std::move(lines));
}

}  // namespace geomend::gridding
