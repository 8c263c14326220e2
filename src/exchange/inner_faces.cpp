// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/inner_faces.h"

#include <algorithm>

#include "model/face_groups.h"

namespace geomend::exchange {

std::vector<InnerFace> inner_faces(const VolumeMeshData& mesh) {
    std::vector<InnerFace> inner;
    each_face_group(mesh, [&](std::span<const KnownFace> group) {
        for (std::size_t i = 1; i < group.size(); ++i) inner.push_back({group[i - 1].face, group[i].face});
    });
    return inner;
}

std::vector<std::uint32_t> nodes_of(const VolumeMeshData& mesh, const CellFaceRef& face) {
    const auto block = std::ranges::upper_bound(mesh.blocks, face.cell, {}, [](const VolumeMeshData::Block& b) { return b.first; }) - 1;
    if (block->type == CellType::polyhedron) {
        const std::uint64_t f = mesh.cell_faces[face.cell] + face.face;
        return {mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f]),
                mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f + 1])};
    }
    std::vector<std::uint32_t> nodes;
    for (const std::uint8_t corner : faces_of(block->type)[face.face].corners()) nodes.push_back(mesh.nodes_of(face.cell)[corner]);
    return nodes;
}

}  // namespace geomend::exchange
