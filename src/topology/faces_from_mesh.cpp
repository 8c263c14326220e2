// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/faces_from_mesh.h"

#include <algorithm>

#include "topology/faces_from_surfaces.h"

namespace geomend::topology {

std::vector<std::vector<std::uint32_t>> cells_by_entity(const CellMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> cells(mesh.entities.size());
    for (std::uint32_t c = 0; c < mesh.cell_entity.size() && c < mesh.cell_count(); ++c) {
        if (mesh.cell_entity[c] < cells.size()) cells[mesh.cell_entity[c]].push_back(c);
    }
    return cells;
}

std::span<const std::uint32_t> corner_nodes(const CellMesh& mesh, std::size_t cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const std::uint32_t corners = node_count(linear_type(mesh.types[cell]));
    return corners == 0 || corners > nodes.size() ? nodes : nodes.first(corners);
}

namespace {

bool all_missing(const Attribute& a) {
    if (!a.no_data) return false;
    for (std::size_t i = 0; i < value_count(a); ++i) {
        if (!is_no_data(a, value_as_double(a, i))) return false;
    }
    return true;
}

}  // namespace

BrepData::Surface surface_of_cells(const CellMesh& mesh, const std::vector<std::uint32_t>& cells,
                                   const std::vector<std::uint32_t>& vertex_of, bool with_point_attributes) {
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
    for (const Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::point && with_point_attributes) result.attributes.push_back(restricted(a, points, a.location));
        if (a.location == AttributeLocation::cell) {
            auto values = restricted(a, cells, AttributeLocation::polygon);
            if (!all_missing(values)) result.attributes.push_back(std::move(values));
        }
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
