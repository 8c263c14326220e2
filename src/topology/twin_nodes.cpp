// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/twin_nodes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>

namespace geomend::topology {

std::vector<std::uint32_t> polygons_by_size(const Polygons& polygons) {
    std::vector<std::uint32_t> order(polygons.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!polygons.all_triangles()) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return polygons[a].size() < polygons[b].size(); });
    }
    return order;
}

std::vector<TwinCorners> twins_of(const BrepData::Surface& surface) {
    std::unordered_map<std::uint32_t, std::uint32_t> first_at;  // vertex -> node
    std::vector<std::uint32_t> twin(surface.nodes.size(), no_index);
    std::vector<std::uint8_t> used(surface.nodes.size(), 0);
    for (const std::uint32_t node : surface.polygons.corners) used[node] = 1;
    std::uint32_t count = 0;
    for (std::uint32_t node = 0; node < surface.nodes.size(); ++node) {
        if (used[node] != 0 && !first_at.emplace(surface.nodes[node].value, node).second) twin[node] = count++;
    }
    std::vector<TwinCorners> result(count);
    if (count == 0) return result;
    const auto order = polygons_by_size(surface.polygons);
    for (std::uint32_t p = 0; p < order.size(); ++p) {
        const auto polygon = surface.polygons[order[p]];
        for (std::uint32_t k = 0; k < polygon.size(); ++k) {
            if (twin[polygon[k]] != no_index) result[twin[polygon[k]]].push_back({p, k});
        }
    }
    return result;
}

std::uint64_t count_twins(const BrepData& brep) {
    std::uint64_t count = 0;
    for (const auto& surface : brep.surfaces) {
        std::vector<VertexId> vertices = surface.nodes;
        std::sort(vertices.begin(), vertices.end());
        count += static_cast<std::uint64_t>(vertices.end() - std::unique(vertices.begin(), vertices.end()));
    }
    return count;
}

std::vector<std::uint32_t> make_twins(const std::vector<TwinCorners>& twins, BrepData::Surface& surface) {
    const auto order = polygons_by_size(surface.polygons);
    std::vector<std::uint32_t> beside;
    for (const TwinCorners& corners : twins) {
        std::vector<std::size_t> places;
        for (const auto& [p, k] : corners) {
            if (p >= order.size() || k >= surface.polygons[order[p]].size()) break;
            const auto place = static_cast<std::size_t>(surface.polygons[order[p]].data() - surface.polygons.corners.data()) + k;
            if (!places.empty() && surface.polygons.corners[place] != surface.polygons.corners[places[0]]) break;
            places.push_back(place);
        }
        if (places.empty() || places.size() < corners.size()) continue;
        const std::uint32_t node = surface.polygons.corners[places[0]];
        const auto twin = static_cast<std::uint32_t>(surface.nodes.size());
        const VertexId vertex = surface.nodes[node];
        surface.nodes.push_back(vertex);
        beside.push_back(node);
        for (const std::size_t place : places) surface.polygons.corners[place] = twin;
    }
    return beside;
}

}  // namespace geomend::topology
