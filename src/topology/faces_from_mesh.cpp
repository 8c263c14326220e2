// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/faces_from_mesh.h"

#include <algorithm>

#include "topology/corner_values.h"
#include "topology/faces_from_surfaces.h"

namespace geomend::topology {

std::vector<std::vector<std::uint32_t>> cells_by_entity(const CellMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> cells(mesh.entities.size());
    for (std::uint32_t c = 0; c < mesh.cell_entity.size() && c < mesh.cell_count(); ++c) {
        const std::uint32_t e = mesh.cell_entity[c];
        if (e < cells.size() && mesh.entities[e].dimension == dimension(mesh.types[c])) cells[e].push_back(c);
    }
    return cells;
}

std::span<const std::uint32_t> corner_nodes(const CellMesh& mesh, std::size_t cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const std::uint32_t corners = node_count(linear_type(mesh.types[cell]));
    return corners == 0 || corners > nodes.size() ? nodes : nodes.first(corners);
}

BrepData::Surface surface_of_cells(const CellMesh& mesh, const std::vector<std::uint32_t>& cells,
                                   const std::vector<std::uint32_t>& vertex_of, std::int64_t tag, const Twins* twins,
                                   bool with_point_attributes) {
    BrepData::Surface result;
    std::vector<std::uint32_t> points;
    for (const std::uint32_t c : cells) {
        const auto nodes = corner_nodes(mesh, c);
        points.insert(points.end(), nodes.begin(), nodes.end());
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const std::uint32_t p : points) result.nodes.emplace_back(vertex_of[p]);
    std::vector<std::uint32_t> polygon;
    for (const std::uint32_t c : cells) {
        polygon.clear();
        for (const std::uint32_t p : corner_nodes(mesh, c)) {
            polygon.push_back(static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), p) - points.begin()));
        }
        result.polygons.push_back(polygon);
    }
    if (twins != nullptr) {
        if (const auto own = twins->find(tag); own != twins->end()) {
            for (const std::uint32_t node : make_twins(own->second, result)) points.push_back(points[node]);
        }
    }
    for (const Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::point && with_point_attributes) result.attributes.push_back(restricted(a, points, a.location));
        if (a.location != AttributeLocation::cell) continue;
        if (components_per_corner(a) > 0) add_corner_values(mesh, a, cells, tag, result);
        else if (!missing_in(a, cells)) result.attributes.push_back(restricted(a, cells, AttributeLocation::polygon));
    }
    return result;
}

StatedLines stated_lines(const CellMesh& mesh, const std::vector<std::vector<std::uint32_t>>& cells,
                         const std::vector<std::uint32_t>& vertex_of) {
    StatedLines stated;
    stated.shared_nodes = true;
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        if (mesh.entities[e].dimension > 1) continue;
        for (const std::uint32_t c : cells[e]) {
            const auto nodes = corner_nodes(mesh, c);
            if (dimension(mesh.types[c]) == 0) {
                for (const std::uint32_t p : nodes) stated.corners.push_back(vertex_of[p]);
            } else if (dimension(mesh.types[c]) == 1) {
                for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
                    stated.edges.push_back({vertex_of[nodes[i]], vertex_of[nodes[i + 1]], e});
                }
            }
        }
    }
    return stated;
}

}  // namespace geomend::topology
