// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/border_pieces.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "model/objects.h"

namespace geomend::repair {

namespace {

constexpr double cosine_of_corner = 0.766;  // 40 degrees

Vec3 unit(const Vec3& v) { return times(1 / std::sqrt(dot(v, v)), v); }

std::vector<BorderEdge> border_edges(const TriangleSoup& soup, const SoupEdges& edges) {
    std::vector<BorderEdge> border;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (!is_free(edges[e])) continue;
        const auto& use = edges[e][0];
        const Triangle& t = soup.triangles[use.triangle];
        BorderEdge b;
        b.from = t[use.corner];
        b.to = t[(use.corner + 1) % 3];
        b.triangle = use.triangle;
        const Vec3 along = minus(soup.vertices[b.to], soup.vertices[b.from]);
        const Vec3 normal = cross(along, minus(soup.vertices[t[(use.corner + 2) % 3]], soup.vertices[b.from]));
        const Vec3 outward = cross(along, normal);
        if (!(dot(outward, outward) > 0)) continue;
        b.outward = unit(outward);
        border.push_back(b);
    }
    return border;
}

/// Joins edges that follow on: one ends where the other begins, both of one patch, and nothing else of it is there.
void link(const TriangleSoup& soup, std::vector<BorderEdge>& border) {
    struct End {
        std::uint32_t patch, vertex, edge;
        bool begins;
    };
    std::vector<End> ends;
    for (std::uint32_t i = 0; i < border.size(); ++i) {
        const std::uint32_t patch = soup.patches[border[i].triangle];
        ends.push_back({patch, border[i].from, i, true});
        ends.push_back({patch, border[i].to, i, false});
    }
    std::ranges::sort(ends, [](const End& a, const End& b) {
        if (a.patch != b.patch) return a.patch < b.patch;
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.edge < b.edge;
    });
    for (std::size_t i = 0; i < ends.size();) {
        std::size_t j = i;
        while (j < ends.size() && ends[j].patch == ends[i].patch && ends[j].vertex == ends[i].vertex) ++j;
        if (j == i + 2 && ends[i].begins != ends[i + 1].begins) {
            const std::uint32_t after = ends[i].begins ? ends[i].edge : ends[i + 1].edge;
            const std::uint32_t before = ends[i].begins ? ends[i + 1].edge : ends[i].edge;
            border[before].next = after;
            border[after].previous = before;
        }
        i = j;
    }
}

bool turns(const TriangleSoup& soup, const BorderEdge& a, const BorderEdge& b) {
    const Vec3 first = minus(soup.vertices[a.to], soup.vertices[a.from]), second = minus(soup.vertices[b.to], soup.vertices[b.from]);
    return dot(first, second) < cosine_of_corner * std::sqrt(dot(first, first) * dot(second, second));
}

}  // namespace

FreeBorders free_borders(const TriangleSoup& soup, const SoupEdges& edges) {
    FreeBorders borders;
    borders.edges = border_edges(soup, edges);
    link(soup, borders.edges);
    std::vector<std::uint8_t> done(borders.edges.size(), 0);
    const auto begins = [&](std::uint32_t e) {
        const std::uint32_t before = borders.edges[e].previous;
        return before == no_index || turns(soup, borders.edges[before], borders.edges[e]);
    };
    const auto collect = [&](std::uint32_t start) {
        std::vector<std::uint32_t> piece;
        for (std::uint32_t e = start; e != no_index && done[e] == 0 && (e == start || !begins(e)); e = borders.edges[e].next) {
            done[e] = 1;
            borders.edges[e].piece = static_cast<std::uint32_t>(borders.pieces.size());
            piece.push_back(e);
        }
        borders.pieces.push_back(std::move(piece));
    };
    for (std::uint32_t e = 0; e < done.size(); ++e) {
        if (done[e] == 0 && begins(e)) collect(e);
    }
    for (std::uint32_t e = 0; e < done.size(); ++e) {  // closed and smooth
        if (done[e] == 0) collect(e);
    }
    return borders;
}

}  // namespace geomend::repair
