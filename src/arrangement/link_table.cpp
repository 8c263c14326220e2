// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/link_table.h"

#include <algorithm>
#include <bit>

#include "geometry/vectors.h"

namespace geomend::arrangement {

namespace {

std::size_t hash_of(const Link& link) {
    std::uint64_t h = (std::uint64_t{link.a} << 32 | link.b) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h ^ h >> 31);
}

}  // namespace

LinkTable::LinkTable(std::span<const Vec3> points, std::vector<VertexOnEdge> on) {
    std::erase_if(on, [](const VertexOnEdge& o) { return o.edge.has(o.vertex) || o.edge.a == o.edge.b; });
    std::sort(on.begin(), on.end());
    on.erase(std::unique(on.begin(), on.end()), on.end());
    if (on.empty()) return;
    std::vector<std::pair<double, std::uint32_t>> along;
    std::uint32_t largest = 0;
    for (std::size_t i = 0; i < on.size();) {
        const Link link = on[i].edge;
        const Vec3 direction = minus(points[link.b], points[link.a]);
        along.clear();
        for (; i < on.size() && on[i].edge == link; ++i) {
            along.emplace_back(dot(direction, minus(points[on[i].vertex], points[link.a])), on[i].vertex);
        }
        std::sort(along.begin(), along.end());
        links_.push_back(link);
        first_.push_back(static_cast<std::uint32_t>(vertices_.size()));
        for (const auto& [where, vertex] : along) vertices_.push_back(vertex);
        largest = std::max(largest, link.b);
    }
    first_.push_back(static_cast<std::uint32_t>(vertices_.size()));
    is_end_.assign(largest + 1, 0);
    slots_.assign(std::bit_ceil(2 * links_.size() + 2), 0);
    for (std::uint32_t l = 0; l < links_.size(); ++l) {
        is_end_[links_[l].a] = is_end_[links_[l].b] = 1;
        std::size_t slot = hash_of(links_[l]) & (slots_.size() - 1);
        while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = l + 1;
    }
}

std::span<const std::uint32_t> LinkTable::on(const Link& link) const {
    if (!may_end_in(link.a) || !may_end_in(link.b)) return {};
    for (std::size_t slot = hash_of(link) & (slots_.size() - 1); slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
        const std::uint32_t l = slots_[slot] - 1;
        if (links_[l] == link) return std::span(vertices_).subspan(first_[l], first_[l + 1] - first_[l]);
    }
    return {};
}

void LinkTable::append(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& way) const {
    const auto found = on(Link(from, to));
    if (from < to) way.insert(way.end(), found.begin(), found.end());
    else way.insert(way.end(), found.rbegin(), found.rend());
}

}  // namespace geomend::arrangement
