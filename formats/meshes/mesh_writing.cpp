// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/mesh_writing.h"

#include <algorithm>
#include <iterator>

namespace geomend::meshes {

std::vector<Loss> common_losses(const VolumeMesh& mesh, std::string_view title) {
    std::vector<Loss> losses;
    const std::string why = std::string(title) + " has no place for it";
    if (mesh->crs != CoordinateSystem{}) add_loss(losses, {LossClass::identity, mesh->name, "coordinate system", why, 1});
    if (!mesh->split_pairs.empty())
        add_loss(losses, {LossClass::identity, mesh->name, "pairs of doubled faces", why, mesh->split_pairs.size()});
    return losses;
}

std::string in_a_line(std::string_view name) {
    std::string line(name);
    std::ranges::replace_if(
        line, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }, ' ');
    return line;
}

std::vector<VolumeMeshData::Block> blocks_of(const VolumeMesh& mesh, CellType type) {
    std::vector<VolumeMeshData::Block> blocks;
    std::ranges::copy_if(mesh->blocks, std::back_inserter(blocks),
                         [&](const VolumeMeshData::Block& block) { return linear_type(block.type) == type; });
    return blocks;
}

std::uint64_t cells_in(std::span<const VolumeMeshData::Block> blocks) {
    std::uint64_t count = 0;
    for (const VolumeMeshData::Block& block : blocks) count += block.count;
    return count;
}

}  // namespace geomend::meshes
