// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/cell_faces.h"
#include "model/objects.h"

// Faces known by their corners, whichever comes first and which way round: so triangles and quadrangles of surfaces find the cells whose
// faces they are.

namespace geomend {

/// The corners of a triangle or quadrangle, ascending; no_index in the place of a fourth one.
using FaceCorners = std::array<std::uint32_t, 4>;

struct FaceCornersHash {
    std::size_t operator()(const FaceCorners& c) const {
        std::size_t hash = 0;
        for (const std::uint32_t v : c) hash = (hash ^ v) * 0x9e3779b97f4a7c15u;
        return hash ^ hash >> 32;
    }
};

/// The first `count` nodes, at most four.
inline FaceCorners face_corners(std::span<const std::uint32_t> nodes, std::size_t count) {
    FaceCorners corners{no_index, no_index, no_index, no_index};
    std::copy_n(nodes.begin(), std::min({count, nodes.size(), corners.size()}), corners.begin());
    std::ranges::sort(corners);
    return corners;
}

/// Of a triangle or quadrangle of a mesh, of any order. \pre cell is two-dimensional
inline FaceCorners face_corners(const CellMesh& mesh, std::size_t cell) {
    return face_corners(mesh.cell_nodes(cell), linear_type(mesh.types[cell]) == CellType::triangle ? 3 : 4);
}

/// The corners by the places where they lie. \param first per point the first one at its place
inline FaceCorners face_places(FaceCorners corners, std::span<const std::uint32_t> first) {
    for (std::uint32_t& p : corners) p = p == no_index ? p : first[p];
    std::ranges::sort(corners);
    return corners;
}

/// Calls visit(cell, corners) for those faces of the cells of a mesh all of whose corners are marked. Linear.
/// \param marked per point
template <class Visit>
void each_marked_face(const CellMesh& mesh, std::span<const std::uint8_t> marked, const Visit& visit) {
    std::vector<std::uint32_t> nodes;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (const LocalFace& face : faces_of(mesh.types[c])) {
            nodes.clear();
            for (const std::uint8_t corner : face.corners()) nodes.push_back(mesh.cell_nodes(c)[corner]);
            const bool all = std::ranges::all_of(nodes, [&](std::uint32_t node) { return marked[node] != 0; });
            if (all) visit(c, face_corners(nodes, nodes.size()));
        }
    }
}

}  // namespace geomend
