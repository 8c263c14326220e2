// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/inner_faces.h"

#include <algorithm>

#include "exchange/each_face.h"

namespace geomend::exchange {

std::vector<InnerFace> inner_faces(const VolumeMeshData& mesh) {
    struct Side {
        std::array<std::uint32_t, 3> lowest;
        std::uint32_t corners;
        CellFaceRef face;
        auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    sides.reserve(4 * mesh.cell_count());
    for (const VolumeMeshData::Block& block : mesh.blocks) {
        each_face(mesh, block, [&](const CellFaceRef& face, std::vector<std::uint32_t>& nodes) {
            std::ranges::partial_sort(nodes, nodes.begin() + 3);
            sides.push_back({{nodes[0], nodes[1], nodes[2]}, static_cast<std::uint32_t>(nodes.size()), face});
        });
    }
    std::ranges::sort(sides);
    std::vector<InnerFace> inner;
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].lowest == sides[i - 1].lowest && sides[i].corners == sides[i - 1].corners)
            inner.push_back({sides[i - 1].face, sides[i].face});
    }
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
