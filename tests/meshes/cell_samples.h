// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/dataset.h"

namespace geomend::test {

/// A cell of some type by its corners, and by the ends of the edges on whose middles its further nodes stand, in VTK's order.
struct SampleCell {
    CellType type;
    std::vector<Vec3> corners;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::vector<std::uint32_t>> faces;  ///< written down from drawings, wound outwards
    double volume;
};

inline std::vector<SampleCell> sample_cells() {
    const std::vector<Vec3> tet{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    const std::vector<Vec3> wedge{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {0, 0, 3}, {0, 2, 3}, {2, 0, 3}};
    const std::vector<Vec3> hex{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}};
    const std::vector<std::vector<std::uint32_t>> tet_faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
        wedge_faces{{0, 1, 2}, {5, 4, 3}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}},
        hex_faces{{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    return {{CellType::tetrahedron, tet, {}, tet_faces, 2},
            {CellType::wedge, wedge, {}, wedge_faces, 6},
            {CellType::hexahedron, hex, {}, hex_faces, 30},
            {CellType::quadratic_tetrahedron, tet, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}, tet_faces, 2},
            {CellType::quadratic_wedge, wedge, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}, wedge_faces, 6},
            {CellType::quadratic_hexahedron,
             hex,
             {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
             hex_faces,
             30}};
}

/// A mesh of the one cell in the region "rock", and a surface "f0", "f1", ... on each of its faces.
inline CellMesh mesh_of(const SampleCell& cell) {
    CellMesh mesh;
    mesh.info.name = "one cell";
    mesh.points = cell.corners;
    for (const auto& [a, b] : cell.edges) {
        const Vec3 &p = cell.corners[a], &q = cell.corners[b];
        mesh.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    }
    const auto add = [&](CellType type, int d, const std::string& name, const std::vector<std::uint32_t>& nodes) {
        CellMesh::Entity entity;
        entity.dimension = d;
        entity.tag = static_cast<std::int64_t>(mesh.entities.size()) + 1;
        entity.name = name;
        mesh.entities.push_back(entity);
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size() - 1));
    };
    std::vector<std::uint32_t> all(mesh.points.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    add(cell.type, 3, "rock", all);
    for (std::size_t f = 0; f < cell.faces.size(); ++f)
        add(cell.faces[f].size() == 3 ? CellType::triangle : CellType::quad, 2, "f" + std::to_string(f), cell.faces[f]);
    return mesh;
}

/// Two boxes side by side, "west" and "east", with the fault "F" between them, a well "W" along edges of the first, and a value in each
/// cell. \param doubled whether the boxes have points of their own on the fault
inline CellMesh two_boxes(bool doubled) {
    CellMesh mesh;
    mesh.info.name = "two boxes";
    mesh.points = {{0, 0, 0},    {1, 0, 0}, {1.5, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1.25, 0, 1},
                   {1.75, 1, 1}, {0, 1, 1}, {3, 0, 0},   {3, 1, 0}, {3, 0, 1}, {3, 1, 1}};
    std::array<std::uint32_t, 4> fault{1, 2, 6, 5};
    if (doubled) {
        for (std::uint32_t& p : fault) {
            mesh.points.push_back(mesh.points[p]);
            p = static_cast<std::uint32_t>(mesh.points.size() - 1);
        }
    }
    const auto entity = [&](int d, const std::string& name, FeatureRole role) {
        CellMesh::Entity e;
        e.dimension = d;
        e.tag = static_cast<std::int64_t>(mesh.entities.size()) + 1;
        e.name = name;
        e.role = role;
        mesh.entities.push_back(e);
    };
    entity(3, "west", FeatureRole::unknown);
    entity(3, "east", FeatureRole::unknown);
    entity(2, "F", FeatureRole::fault);
    entity(1, "W", FeatureRole::unknown);
    const auto add = [&](CellType type, std::vector<std::uint32_t> nodes, std::uint32_t of) {
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(of);
    };
    add(CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 0);
    add(CellType::hexahedron, {fault[0], 8, 9, fault[1], fault[3], 10, 11, fault[2]}, 1);
    add(CellType::quad, {1, 2, 6, 5}, 2);
    add(CellType::line, {0, 4}, 3);
    add(CellType::line, {4, 7}, 3);
    return mesh;
}

}  // namespace geomend::test
