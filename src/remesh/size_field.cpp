// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/size_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "base/vectors.h"

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

}  // namespace

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
