// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/mesh_writing.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <type_traits>

namespace geomend::meshes {

std::vector<Loss> common_losses(const VolumeMesh& mesh, std::string_view title) {
    std::vector<Loss> losses;
    const std::string why = std::string(title) + " has no place for it";
    if (mesh->crs != CoordinateSystem{}) add_loss(losses, {LossClass::identity, mesh->name, "coordinate system", why, 1});
    if (!mesh->split_pairs.empty())
        add_loss(losses, {LossClass::identity, mesh->name, "pairs of doubled faces", why, mesh->split_pairs.size()});
    const auto roles = std::ranges::count_if(mesh->face_sets, [](const auto& set) {
        return set.surface != no_index && set.role != FeatureRole::unknown;  // not of faces between or around regions, which nobody stated
    });
    if (roles > 0)
        add_loss(losses, {LossClass::identity, mesh->name, "roles of surfaces", std::string(title) + " has no place for them",
                          static_cast<std::uint64_t>(roles)});
    return losses;
}

std::string in_a_line(std::string_view name) {
    std::string line(name);
    std::ranges::replace_if(
        line, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }, ' ');
    return line;
}

bool is_text(const Attribute& a) { return std::holds_alternative<std::vector<std::string>>(a.values); }

void write_attribute_values(OutputFile& file, const Attribute& a, std::size_t thing) {
    std::visit(
        [&](const auto& values) {
            using Value = typename std::decay_t<decltype(values)>::value_type;
            for (std::size_t k = 0; k < a.components; ++k) {
                [[maybe_unused]] const Value& value = values[thing * a.components + k];
                if constexpr (std::is_floating_point_v<Value>) file << ' ', file.number(value);
                else if constexpr (std::is_signed_v<Value>) file << ' ', file.number(static_cast<std::int64_t>(value));
                else if constexpr (std::is_integral_v<Value>) file << ' ', file.number(static_cast<std::uint64_t>(value));
            }
        },
        a.values);
}

std::vector<CellFaceRef> shared_faces(const CellNetwork& network) {
    std::vector<CellFaceRef> shared;
    for (const auto& c : network.connections) shared.insert(shared.end(), {{c.from, c.from_face}, {c.to, c.to_face}});
    std::ranges::sort(shared);
    return shared;
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
