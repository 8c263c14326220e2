// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "model/cell_faces.h"
#include "model/volume_mesh.h"

namespace geomend {

/// Calls body(CellFaceRef, nodes) for each face of the cells of a block, with its nodes wound outwards in a list that the body may
/// change. For data that no VolumeMesh is made of yet. \pre the block is one of the data's
template <class Body>
void each_face(const VolumeMeshData& data, const VolumeMeshData::Block& block, const Body& body) {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
        std::uint32_t number = 0;
        for (const LocalFace& face : faces_of(block.type)) {
            nodes.clear();
            for (const std::uint8_t corner : face.corners()) nodes.push_back(data.nodes_of(c)[corner]);
            body(CellFaceRef{c, number++}, nodes);
        }
        if (block.type != CellType::polyhedron) continue;
        for (std::uint64_t f = data.cell_faces[c]; f < data.cell_faces[c + 1]; ++f) {
            nodes.assign(data.face_nodes.begin() + static_cast<std::ptrdiff_t>(data.face_offsets[f]),
                         data.face_nodes.begin() + static_cast<std::ptrdiff_t>(data.face_offsets[f + 1]));
            body(CellFaceRef{c, number++}, nodes);
        }
    }
}

}  // namespace geomend
