// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/region_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "exchange/each_face.h"

namespace geomend::exchange {

namespace {

using Data = VolumeMeshData;

struct PlacedFace {
    std::array<std::uint32_t, 3> lowest;  // places
    std::uint32_t corners, region;
    CellFaceRef face;
    auto place() const { return std::tie(lowest, corners); }
};

std::vector<PlacedFace> placed_faces(const SolidCells& cells) {
    std::vector<PlacedFace> all;
    for (const Data::Block& block : cells.data.blocks) {
        each_face(cells.data, block, [&](const CellFaceRef& face, std::vector<std::uint32_t>& nodes) {
            for (std::uint32_t& n : nodes) n = cells.place_of[n];
            std::ranges::partial_sort(nodes, nodes.begin() + 3);
            all.push_back({{nodes[0], nodes[1], nodes[2]}, static_cast<std::uint32_t>(nodes.size()), block.region, face});
        });
    }
    std::ranges::sort(all, [](const PlacedFace& a, const PlacedFace& b) {
        return std::tie(a.lowest, a.corners, a.region, a.face) < std::tie(b.lowest, b.corners, b.region, b.face);
    });
    return all;
}

}  // namespace

void add_region_faces(SolidCells& cells) {
    Data& d = cells.data;
    std::vector<CellFaceRef> known;
    for (const Data::FaceSet& set : d.face_sets) known.insert(known.end(), set.faces.begin(), set.faces.end());
    std::ranges::sort(known);
    const auto is_known = [&](const PlacedFace& f) { return std::ranges::binary_search(known, f.face); };
    const std::vector<PlacedFace> faces = placed_faces(cells);
    std::map<std::array<std::uint32_t, 2>, std::vector<CellFaceRef>> sets;  // of two regions; no_index: the outside
    for (auto first = faces.begin(); first != faces.end();) {
        const auto end = std::find_if(first, faces.end(), [&](const PlacedFace& f) { return f.place() != first->place(); });
        const std::uint32_t other = end - first == 1 ? no_index : std::prev(end)->region;
        if (other != first->region && std::none_of(first, end, is_known)) sets[{first->region, other}].push_back(first->face);
        first = end;
    }
    for (auto& [regions, members] : sets) {
        const bool outside = regions[1] == no_index;
        std::ranges::sort(members);
        d.face_sets.push_back({d.regions[regions[0]] + "_" + (outside ? "outside" : d.regions[regions[1]]),
                               outside ? FeatureRole::boundary : FeatureRole::unknown, FaceSide::none, no_index, std::move(members)});
    }
}

}  // namespace geomend::exchange
