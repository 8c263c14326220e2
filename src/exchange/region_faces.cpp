// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/region_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "model/face_groups.h"

namespace geomend::exchange {

namespace {

using Data = VolumeMeshData;

}  // namespace

void add_region_faces(SolidCells& cells) {
    Data& d = cells.data;
    std::vector<CellFaceRef> known;
    for (const Data::FaceSet& set : d.face_sets) known.insert(known.end(), set.faces.begin(), set.faces.end());
    std::ranges::sort(known);
    const auto is_known = [&](const KnownFace& f) { return std::ranges::binary_search(known, f.face); };
    std::vector<std::uint32_t> region_of;
    for (const Data::Block& block : d.blocks) region_of.resize(block.first + block.count, block.region);
    const auto region = [&](const KnownFace& f) { return region_of[f.face.cell]; };
    std::map<std::array<std::uint32_t, 2>, std::vector<CellFaceRef>> sets;  // of two regions; no_index: the outside
    const auto place_of = [&](std::uint32_t vertex) { return cells.place_of[vertex]; };
    each_face_group(d, cells.places.positions().size(), place_of, [&](std::span<const KnownFace> group) {  // cells ascend, so do regions
        const std::uint32_t first = region(group.front()), other = group.size() == 1 ? no_index : region(group.back());
        if (other != first && std::ranges::none_of(group, is_known)) sets[{first, other}].push_back(group.front().face);
    });
    for (auto& [regions, members] : sets) {
        const bool outside = regions[1] == no_index;
        std::ranges::sort(members);
        d.face_sets.push_back({d.regions[regions[0]] + "_" + (outside ? "outside" : d.regions[regions[1]]),
                               outside ? FeatureRole::boundary : FeatureRole::unknown, FaceSide::none, no_index, std::move(members)});
    }
}

}  // namespace geomend::exchange
