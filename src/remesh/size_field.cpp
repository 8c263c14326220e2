// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/size_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "base/length.h"
#include "base/vectors.h"
#include "geometry/segment_tree.h"

namespace geomend::remeshing {

namespace {

/// The edges of all surfaces, from either end: compressed rows.
struct VertexEdges {
    std::vector<std::uint64_t> first;
    std::vector<std::uint32_t> to;
};

template <class Visit>
void visit_edges(const BrepData& brep, const Visit& visit) {
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t k = 0; k < polygon.size(); ++k)
                visit(surface.nodes[polygon[k]].value, surface.nodes[polygon[(k + 1) % polygon.size()]].value);
        }
    }
}

VertexEdges vertex_edges(const BrepData& brep) {
    VertexEdges edges;
    edges.first.assign(brep.vertices.size() + 1, 0);
    visit_edges(brep, [&](std::uint32_t a, std::uint32_t b) {
        ++edges.first[a];
        ++edges.first[b];
    });
    std::uint64_t end = 0;
    for (std::uint64_t& f : edges.first) f = end += f;
    edges.to.resize(end);
    visit_edges(brep, [&](std::uint32_t a, std::uint32_t b) {
        edges.to[--edges.first[a]] = b;
        edges.to[--edges.first[b]] = a;
    });
    return edges;
}

/// An edge of a sampled line.
struct LineEdge {
    std::uint32_t line = 0, first = 0, last = 0;  ///< points of the line around it
    double longest = 0;                           ///< size there
};

/// Whether two points of lines are close only because both lines come from one corner.
bool meet_at_corner(const BrepData& brep, const BrepData::Line& a, const BrepData::Line& b, const SegmentDistance& gap) {
    for (const CornerId c : a.corners) {
        if (c != b.corners[0] && c != b.corners[1]) continue;
        const Vec3& corner = brep.vertices[brep.corners[c.value].vertex.value];
        if (length(minus(gap.on_first, corner)) + length(minus(gap.on_second, corner)) <= 3 * gap.distance) return true;
    }
    return false;
}

void limit_by_width(const BrepData& brep, const BrepData::Surface& surface, const LinePlan& lines, double least,
                    std::vector<double>& sizes) {
    std::vector<Segment> segments;
    std::vector<LineEdge> edges;
    double farthest = 0;
    std::vector<std::uint32_t> own;
    for (const auto& use : surface.lines) own.push_back(use.line.value);
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const std::uint32_t l : own) {
        const auto samples = lines.samples(l);
        for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
            const auto &from = samples[k], &to = samples[k + 1];
            LineEdge edge{l, from.sample.segment, to.sample.share > 0 ? to.sample.segment + 1 : to.sample.segment, 0};
            for (std::uint32_t i = edge.first; i <= edge.last; ++i)
                edge.longest = std::max(edge.longest, sizes[brep.lines[l].vertices[i].value]);
            segments.push_back({lines.place(from.name), lines.place(to.name)});
            edges.push_back(edge);
            farthest = std::max(farthest, edge.longest);
        }
    }
    SegmentTree(segments, farthest).visit_pairs([&](std::uint32_t i, std::uint32_t j) {
        const LineEdge &a = edges[i], &b = edges[j];
        if (a.line == b.line) return true;
        const SegmentDistance gap = closest_points(segments[i], segments[j]);
        const double size = 1.2 * gap.distance;
        if (!(size >= least) || size >= std::max(a.longest, b.longest)) return true;
        if (meet_at_corner(brep, brep.lines[a.line], brep.lines[b.line], gap)) return true;
        for (const LineEdge* e : {&a, &b}) {
            for (std::uint32_t p = e->first; p <= e->last; ++p) {
                double& s = sizes[brep.lines[e->line].vertices[p].value];
                s = std::min(s, size);
            }
        }
        return true;
    });
}

}  // namespace

void limit_by_width(const BrepData& brep, const LinePlan& lines, double least, std::vector<double>& sizes) {
    for (const auto& surface : brep.surfaces) limit_by_width(brep, surface, lines, least, sizes);
}

std::vector<double> entity_sizes(const BrepData& brep, double size, std::span<const std::pair<std::string, double>> of) {
    std::vector<double> sizes(brep.vertices.size(), HUGE_VAL);
    for (const auto& surface : brep.surfaces) {
        double own = size;
        for (const auto& [name, value] : of) {
            const bool of_interface = surface.interface_id.valid() && brep.interfaces[surface.interface_id.value].name == name;
            if (of_interface || surface.name == name) own = value;
        }
        for (const VertexId v : surface.nodes) sizes[v.value] = std::min(sizes[v.value], own);
    }
    for (double& s : sizes) {
        if (s == HUGE_VAL) s = size;
    }
    return sizes;
}

void grade(const BrepData& brep, double growth, std::vector<double>& sizes) {
    const auto limit = [&](std::uint32_t from, std::uint32_t to) {
        const Vec3 d = minus(brep.vertices[to], brep.vertices[from]);
        return sizes[from] + growth * std::sqrt(dot(d, d));
    };
    using Item = std::pair<double, std::uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    std::vector<std::uint8_t> starts(sizes.size(), 0);
    visit_edges(brep, [&](std::uint32_t a, std::uint32_t b) {
        if (sizes[b] > limit(a, b)) starts[a] = 1;
        if (sizes[a] > limit(b, a)) starts[b] = 1;
    });
    for (std::uint32_t v = 0; v < starts.size(); ++v) {
        if (starts[v] != 0) queue.emplace(sizes[v], v);
    }
    if (queue.empty()) return;
    const VertexEdges edges = vertex_edges(brep);
    while (!queue.empty()) {
        const auto [size, v] = queue.top();
        queue.pop();
        if (size > sizes[v]) continue;
        for (std::uint64_t e = edges.first[v]; e < edges.first[v + 1]; ++e) {
            const std::uint32_t w = edges.to[e];
            const double most = limit(v, w);
            if (!(sizes[w] > most)) continue;
            sizes[w] = most;
            queue.emplace(most, w);
        }
    }
}

}  // namespace geomend::remeshing
