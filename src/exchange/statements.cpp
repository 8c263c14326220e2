// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/statements.h"

#include <optional>

namespace geomend::exchange {

namespace {

std::optional<std::array<Vec3, 3>> key_of(const BrepData& brep, const BrepData::Surface& surface) {
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        if (polygon.size() < 3) continue;
        std::array<Vec3, 3> key{};
        for (std::size_t i = 0; i < 3; ++i) key[i] = brep.vertices[surface.nodes[polygon[i]].value];
        if (key[0] != key[1] && key[1] != key[2] && key[2] != key[0]) return key;
    }
    return std::nullopt;
}

class StatementWriter {
public:
    StatementWriter(const BrepData& brep, StatedModel& out) : brep_(brep), out_(out) {}

    void add_faces(const std::vector<FacePlace>& places) {
        face_of_.assign(brep_.surfaces.size(), no_index);
        for (const FacePlace& place : places) {
            const auto& surface = brep_.surfaces[place.surface.value];
            face_of_[place.surface.value] = static_cast<std::uint32_t>(out_.faces.size());
            StatedModel::Face face;
            face.number = static_cast<std::int64_t>(out_.faces.size()) + 1;
            face.object = place.object;
            face.part = place.part;
            face.interface_name = surface.interface_id.valid() ? brep_.interfaces[surface.interface_id.value].name : surface.name;
            face.name = surface.name;
            face.role = surface.role;
            face.role_text = surface.role_text;
            face.key = key_of(brep_, surface);
            out_.faces.push_back(std::move(face));
        }
    }

    void add_regions() {
        std::int64_t number = static_cast<std::int64_t>(out_.faces.size()) + 1;
        if (!brep_.universe.empty()) out_.regions.push_back({number++, "Universe", true, sides(brep_.universe)});
        first_region_ = static_cast<std::uint32_t>(out_.regions.size());
        for (const auto& region : brep_.regions) out_.regions.push_back({number++, region.name, false, sides(region.sides)});
        add_lists(brep_.layers, out_.layers);
        add_lists(brep_.fault_blocks, out_.fault_blocks);
    }

    void add_features() {
        for (const auto& feature : brep_.features) {
            StatedModel::Feature made{feature.name, {}};
            for (const SurfaceId s : feature.surfaces) made.faces.push_back(face_of_[s.value]);
            out_.features.push_back(std::move(made));
        }
        for (const auto& corner : brep_.corners) {
            if (!corner.name.empty()) out_.corners.push_back({corner.name, brep_.vertices[corner.vertex.value]});
        }
    }

private:
    std::vector<StatedModel::Side> sides(const std::vector<BrepData::Side>& from) const {
        std::vector<StatedModel::Side> result;
        for (const auto& side : from) result.push_back({face_of_[side.surface.value], side.front});
        return result;
    }
    void add_lists(const std::vector<BrepData::RegionList>& from, std::vector<StatedModel::RegionList>& to) const {
        for (const auto& list : from) {
            StatedModel::RegionList made;
            made.name = list.name;
            made.unresolved = list.unresolved;
            for (const RegionId r : list.regions) made.regions.push_back(first_region_ + r.value);
            to.push_back(std::move(made));
        }
    }

    const BrepData& brep_;
    StatedModel& out_;
    std::vector<std::uint32_t> face_of_;
    std::uint32_t first_region_ = 0;
};

}  // namespace

StatedModel stated_model(const BrepData& brep, const std::vector<FacePlace>& places) {
    StatedModel model;
    model.name = brep.name;
    model.crs = brep.crs;
    model.annotations = brep.annotations;
    StatementWriter writer(brep, model);
    writer.add_faces(places);
    writer.add_regions();
    writer.add_features();
    return model;
}

}  // namespace geomend::exchange
