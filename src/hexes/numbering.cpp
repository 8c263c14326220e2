// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/numbering.h"

#include <algorithm>
#include <array>
#include <set>

#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

using Order = std::array<std::uint8_t, 8>;

/// The corners of a cell in other orders: entry k is the old number of corner k.
std::span<const Order> orders_of(CellType type) {
    static constexpr std::array<Order, 4> pyramid{{{0, 1, 2, 3, 4}, {1, 2, 3, 0, 4}, {2, 3, 0, 1, 4}, {3, 0, 1, 2, 4}}};
    static constexpr std::array<Order, 6> prism{
        {{0, 1, 2, 3, 4, 5}, {1, 2, 0, 4, 5, 3}, {2, 0, 1, 5, 3, 4}, {3, 5, 4, 0, 2, 1}, {5, 4, 3, 2, 1, 0}, {4, 3, 5, 1, 0, 2}}};
    static constexpr std::array<Order, 1> only{{{0, 1, 2, 3, 4, 5, 6, 7}}};
    if (type == CellType::pyramid) return pyramid;
    if (type == CellType::wedge) return prism;
    return only;
}

constexpr std::size_t no_order = 99;

std::size_t order_that_is_taken(const CellCheck& check, CellType type, std::span<const Vec3> corners) {
    const auto orders = orders_of(type);
    std::array<Vec3, 8> p{};
    for (std::size_t n = 0; n < orders.size(); ++n) {
        for (std::size_t k = 0; k < corners.size(); ++k) p[k] = corners[orders[n][k]];
        if (check(type, std::span(p.data(), corners.size()))) return n;
    }
    return no_order;
}

/// The number that a face has after its cell's corners were ordered anew.
std::uint32_t face_after(CellType type, const Order& order, std::uint32_t face) {
    const auto faces = faces_of(type);
    const auto old = faces[face].corners();
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const auto now = faces[f].corners();
        if (now.size() == old.size() && std::ranges::all_of(now, [&](auto k) { return std::ranges::find(old, order[k]) != old.end(); }))
            return f;
    }
    return face;
}

std::array<std::uint32_t, 4> quad_of(const MixedMesh::Cell& cell, const LocalFace& face) {
    std::array<std::uint32_t, 4> quad{};
    for (std::size_t k = 0; k < 4; ++k) quad[k] = cell.corners[face.corners()[k]];
    std::ranges::sort(quad);
    return quad;
}

}  // namespace

bool is_taken(const CellCheck& check, CellType type, std::span<const Vec3> corners) {
    return order_that_is_taken(check, type, corners) != no_order;
}

std::vector<std::uint32_t> number_corners(MixedMesh& mesh, const CellCheck& check) {
    std::vector<std::uint32_t> not_taken;
    std::vector<std::uint8_t> chosen(mesh.cells.size(), 0);
    std::vector<Vec3> corners;
    for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
        MixedMesh::Cell& cell = mesh.cells[c];
        if (orders_of(cell.type).size() == 1) continue;
        corners.clear();
        for (std::size_t k = 0; k < node_count(cell.type); ++k) corners.push_back(mesh.positions[cell.corners[k]]);
        const std::size_t n = order_that_is_taken(check, cell.type, corners);
        if (n == no_order) {
            not_taken.push_back(c);
            continue;
        }
        chosen[c] = static_cast<std::uint8_t>(n);
        const auto old = cell.corners;
        for (std::size_t k = 0; k < corners.size(); ++k) cell.corners[k] = old[orders_of(cell.type)[n][k]];
    }
    for (CellFaceRef& place : mesh.facet_places) {
        if (place.cell == no_index || chosen[place.cell] == 0) continue;
        const CellType type = mesh.cells[place.cell].type;
        place.face = face_after(type, orders_of(type)[chosen[place.cell]], place.face);
    }
    return not_taken;
}

std::vector<std::uint32_t> beside_cells(const MixedMesh& mesh, std::span<const std::uint32_t> some, std::size_t count) {
    std::set<std::array<std::uint32_t, 4>> quads;
    std::vector<std::uint32_t> beside;
    const auto visit_quads = [&](std::uint32_t c, const auto& visit) {
        for (const LocalFace& face : faces_of(mesh.cells[c].type)) {
            if (face.count == 4) visit(quad_of(mesh.cells[c], face));
        }
    };
    for (const std::uint32_t c : some) visit_quads(c, [&](const auto& quad) { quads.insert(quad); });
    for (std::uint32_t c = 0; c < count; ++c) {
        bool is_beside = false;
        visit_quads(c, [&](const auto& quad) { is_beside = is_beside || quads.contains(quad); });
        if (is_beside) beside.push_back(c);
    }
    return beside;
}

}  // namespace geomend::hexes
