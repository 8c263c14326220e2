// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/stated_records.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/wording.h"

namespace geomend::validators {

namespace {

/// Sides of surfaces, or of faces, that are in one list: bit 0 the back, bit 1 the front.
class SideMasks {
public:
    explicit SideMasks(std::size_t count) : masks_(count, 0) {}
    void add(std::size_t number, bool front) {
        if (number < masks_.size()) masks_[number] |= static_cast<std::uint8_t>(front ? 2 : 1);
    }
    /// The only side of a number; nothing where it has none or both.
    std::optional<bool> only_side(std::size_t number) const {
        if (masks_[number] == 0 || masks_[number] == 3) return std::nullopt;
        return masks_[number] == 2;
    }
    void forget(std::size_t number) {
        if (number < masks_.size()) masks_[number] = 0;
    }

private:
    std::vector<std::uint8_t> masks_;
};

}  // namespace

StatedRecords::StatedRecords(const ModelScope& scope) : scope_(scope) {
    const BrepData& brep = scope.brep();
    if (!scope.model().stated) return;
    faces_.resize(brep.surfaces.size(), nullptr);
    signs_.resize(brep.surfaces.size(), Sign::unknown);
    for (const StatedModel& model : scope.dataset().models) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, const StatedModel::Face*> of_part;
        for (const auto& face : model.faces) of_part.emplace(std::pair(face.object, face.part), &face);
        bool is_its = false;
        for (std::size_t s = 0; s < faces_.size(); ++s) {
            const auto face = of_part.find({brep.surfaces[s].source_object, brep.surfaces[s].source_part});
            if (face == of_part.end() || faces_[s] != nullptr) continue;
            faces_[s] = face->second;
            is_its = true;
        }
        if (!is_its || !regions_.empty()) continue;
        find_regions(model);
        find_signs(model);
    }
}

/// Those of the model are the stated ones but for the Universe, in their order, where no cells say otherwise.
void StatedRecords::find_regions(const StatedModel& model) {
    const auto& made = scope_.brep().regions;
    for (const auto& region : model.regions) {
        if (region.universe) universe_ = &region;
        else if (regions_.size() < made.size() && made[regions_.size()].name == region.name) regions_.push_back(&region);
    }
}

/// Each list once, whatever the number of surfaces: a model of thousands of regions has as many lists.
void StatedRecords::find_signs(const StatedModel& model) {
    const BrepData& brep = scope_.brep();
    std::vector<std::uint8_t> contradicts(signs_.size(), 0);
    SideMasks stated(model.faces.size()), made(signs_.size());
    const auto compare = [&](const StatedModel::Region& region, const std::vector<BrepData::Side>& sides) {
        for (const auto& side : region.sides) stated.add(side.face, side.front);
        for (const auto& side : sides) made.add(side.surface.value, side.front);
        for (const auto& side : sides) {
            const std::uint32_t s = side.surface.value;
            if (faces_[s] == nullptr) continue;
            const auto by_file = stated.only_side(static_cast<std::size_t>(faces_[s] - model.faces.data()));
            const auto by_model = made.only_side(s);
            if (!by_file || !by_model) continue;
            const Sign sign = *by_file == *by_model ? Sign::as_normals : Sign::against_normals;
            if (signs_[s] != Sign::unknown && signs_[s] != sign) contradicts[s] = 1;
            signs_[s] = sign;
        }
        for (const auto& side : region.sides) stated.forget(side.face);
        for (const auto& side : sides) made.forget(side.surface.value);
    };
    std::vector<std::uint8_t> is_wrong(regions_.size(), 0);
    for (const auto& wrong : scope_.model().claims.wrong_sides) {
        if (wrong.region >= 0 && static_cast<std::size_t>(wrong.region) < is_wrong.size())
            is_wrong[static_cast<std::size_t>(wrong.region)] = 1;
    }
    for (std::size_t r = 0; r < regions_.size(); ++r) {
        if (is_wrong[r] == 0) compare(*regions_[r], brep.regions[r].sides);
    }
    if (universe_ != nullptr) compare(*universe_, scope_.model().claims.universe);
    for (std::size_t s = 0; s < signs_.size(); ++s) {
        if (contradicts[s] != 0) signs_[s] = Sign::unknown;
    }
}

std::string StatedRecords::surface_in_file(std::uint32_t s) const {
    const auto& surface = scope_.brep().surfaces[s];
    if (const auto* stated = face(s)) {
        if (scope_.dataset().format == "gocad") return "TFACE " + std::to_string(stated->number) + " of " + quoted(stated->interface_name);
        return stated->name.empty() || stated->name == surface.name ? std::string() : quoted(stated->name);
    }
    if (surface.source_object >= scope_.dataset().objects.size()) return {};
    const Object& object = scope_.dataset().objects[surface.source_object];
    const auto* mesh = std::get_if<CellMesh>(&object);
    if (mesh != nullptr && surface.source_part < mesh->entities.size())
        return "entity " + std::to_string(mesh->entities[surface.source_part].tag);
    const std::string& whole = info_of(object).name;
    return whole.empty() || whole == surface.name ? std::string() : "a part of " + quoted(whole);
}

std::string StatedRecords::region_in_file(std::uint32_t r) const {
    const auto* stated = region(r);
    if (stated == nullptr || stated->number <= 0 || scope_.dataset().format != "gocad") return {};
    return "REGION " + std::to_string(stated->number);
}

std::optional<std::string> StatedRecords::side_in_lists(std::uint32_t side) const {
    const auto* stated = face(side / 2);
    if (stated == nullptr || scope_.dataset().format != "gocad" || signs_[side / 2] == Sign::unknown) return std::nullopt;
    const bool is_plus = (side % 2 == 1) == (signs_[side / 2] == Sign::as_normals);
    return (is_plus ? "+" : "-") + std::to_string(stated->number);
}

std::string StatedRecords::sides_text(const std::vector<std::uint32_t>& sides) const {
    constexpr std::size_t named = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(named, sides.size()); ++i) {
        const std::uint32_t s = sides[i] / 2;
        const auto listed = side_in_lists(sides[i]);
        text += text.empty() ? "" : ", ";
        if (listed) text += *listed + " (" + surface_in_file(s) + ")";
        else text += (sides[i] % 2 == 1 ? "the front of " : "the back of ") + quoted(scope_.brep().surfaces[s].name);
    }
    return text + (sides.size() > named ? ", ..." : "");
}

}  // namespace geomend::validators
