// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/soup_mesh.h"

#include <algorithm>
#include <numeric>

#include "model/objects.h"

namespace geomend::editing {

SoupMesh::SoupMesh(TriangleSoup soup)
    : soup_(std::move(soup)),
      from_(soup_.triangles.size()),
      first_made_(soup_.vertices.size()),
      live_(soup_.triangles.size(), 1),
      marked_(soup_.vertices.size(), 0),
      around_(soup_.vertices.size()) {
    std::iota(from_.begin(), from_.end(), 0u);
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
        for (const std::uint32_t v : soup_.triangles[t]) around_[v].push_back(t);
    }
    for (const auto& [a, b] : soup_.edges) marked_[a] = marked_[b] = 1;
}

bool SoupMesh::has_edge(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::any_of(around_[a],
                               [&](std::uint32_t t) { return std::ranges::find(soup_.triangles[t], b) != soup_.triangles[t].end(); });
}

std::uint32_t SoupMesh::add(const Triangle& triangle, std::uint32_t patch, std::uint32_t from) {
    const auto t = static_cast<std::uint32_t>(soup_.triangles.size());
    soup_.triangles.push_back(triangle);
    soup_.patches.push_back(patch);
    from_.push_back(from);
    live_.push_back(1);
    for (const std::uint32_t v : triangle) around_[v].push_back(t);
    return t;
}

std::uint32_t SoupMesh::add_vertex(const Vec3& place, const Origin::Vertex& origin) {
    soup_.vertices.push_back(place);
    made_.push_back(origin);
    marked_.push_back(0);
    around_.emplace_back();
    return static_cast<std::uint32_t>(soup_.vertices.size() - 1);
}

void SoupMesh::drop(std::uint32_t t) {
    live_[t] = 0;
    for (const std::uint32_t v : soup_.triangles[t]) std::erase(around_[v], t);
}

EditedSoup SoupMesh::take() && {
    EditedSoup edited;
    std::vector<std::uint32_t> order;
    for (std::uint32_t t = 0; t < live_.size(); ++t) {
        if (live_[t] != 0) order.push_back(t);
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return from_[t]; });
    std::vector<std::uint32_t> number(soup_.vertices.size(), no_index);
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        if (around_[v].empty() && marked_[v] == 0) continue;
        number[v] = static_cast<std::uint32_t>(edited.soup.vertices.size());
        edited.soup.vertices.push_back(soup_.vertices[v]);
        edited.origin.vertices.push_back(v < first_made_ ? Origin::from_vertex(v) : made_[v - first_made_]);
    }
    for (const std::uint32_t t : order) {
        const auto& [a, b, c] = soup_.triangles[t];
        edited.soup.triangles.push_back({number[a], number[b], number[c]});
        edited.soup.patches.push_back(soup_.patches[t]);
        edited.origin.triangles.push_back(from_[t]);
    }
    for (const auto& [a, b] : soup_.edges) edited.soup.edges.push_back({number[a], number[b]});
    edited.soup.edge_ids = std::move(soup_.edge_ids);
    return edited;
}

}  // namespace geomend::editing
