// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "base/wording.h"
#include "geometry/vectors.h"
#include "validators/cell_findings.h"
#include "validators/model_checks.h"
#include "validators/places.h"
#include "validators/stated_records.h"

// What a file states of the sides of its regions and of its Universe, against its surfaces.

namespace geomend::validators {

namespace {

/// Names surfaces in a finding and marks each near its middle.
void name_surfaces_at(const ModelScope& scope, std::span<const std::uint32_t> surfaces, Finding& finding) {
    const BrepData& brep = scope.brep();
    finding.count = std::max<std::uint64_t>(1, surfaces.size());
    finding.element_kind = "surface";
    for (const std::uint32_t s : surfaces) {
        if (finding.entities.size() >= listed_elements) break;
        finding.entities.push_back(surface_ref(scope, s));
        finding.index.push_back(s);
        if (brep.surfaces[s].polygons.size() > 0) finding.points.push_back(middle_of_surface(scope, s));
    }
}

std::string first_names(const ModelScope& scope, std::span<const std::uint32_t> surfaces) {
    constexpr std::size_t named = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(named, surfaces.size()); ++i)
        text += (i == 0 ? "" : ", ") + quoted(scope.brep().surfaces[surfaces[i]].name);
    return text + (surfaces.size() > named ? ", ..." : "");
}

/// Whether the file's own key triangles disagree with its surfaces, so that a sign may mean either side.
bool keys_are_reversed(const Dataset& dataset) {
    return std::ranges::any_of(dataset.findings, [](const Finding& f) { return f.code == "F106"; });
}

/// Whether some sides cancel out along each line; those with both sides of a surface do by themselves.
bool closes(const ModelScope& scope, std::span<const BrepData::Side> sides) {
    std::map<std::uint32_t, std::int64_t> net;
    for (const auto& side : sides) {
        for (const auto& [line, sum] : scope.model().graph.nets[side.surface.value]) net[line] += side.front ? -sum : sum;
    }
    return !sides.empty() && std::ranges::all_of(net, [](const auto& entry) { return entry.second == 0; });
}

/// Per side (2 x surface, + 1 for its front) 1 where one of the lists has it.
template <class Sides>
void mark_sides(const Sides& sides, std::vector<std::uint8_t>& marked) {
    for (const auto& side : sides) marked[2 * side.surface.value + (side.front ? 1 : 0)] = 1;
}

/// The sides of some surfaces as the list of a region has them: "+4 (TFACE 4 of 'H1')". \param region -1: the Universe
std::string stated_signs(const ModelScope& scope, const StatedRecords& records, std::int64_t region,
                         std::span<const std::uint32_t> surfaces) {
    constexpr std::size_t named = 5;
    const auto* list = region < 0 ? records.universe() : records.region(static_cast<std::uint32_t>(region));
    if (list == nullptr || scope.dataset().format != "gocad") return {};
    std::string text;
    std::size_t count = 0;
    for (const std::uint32_t s : surfaces) {
        const auto* face = records.face(s);
        if (face == nullptr) continue;
        for (const auto& model : scope.dataset().models) {
            for (const auto& side : list->sides) {
                if (side.face >= model.faces.size() || &model.faces[side.face] != face || count++ >= named) continue;
                text += (text.empty() ? "" : ", ") + std::string(side.front ? "+" : "-") + std::to_string(face->number) + " (" +
                        records.surface_in_file(s) + ")";
            }
        }
    }
    return text + (count > named ? ", ..." : "");
}

}  // namespace

void check_stated_sides(const ModelScope& scope, std::vector<Finding>& findings) {
    const topology::StatedClaims& claims = scope.model().claims;
    if (claims.wrong_sides.empty() && !claims.reversed_convention) return;
    const StatedRecords records(scope);
    for (const auto& wrong : claims.wrong_sides) {
        std::vector<std::uint32_t> surfaces;
        for (const SurfaceId s : wrong.turned) surfaces.push_back(s.value);
        std::string message = "region " + quoted(wrong.name) + " is stated on the wrong side of " + first_names(scope, surfaces);
        if (wrong.volume_as_stated != wrong.volume)
            message += ": as stated its volume is " + rounded(wrong.volume_as_stated) + ", the surfaces enclose " + rounded(wrong.volume);
        const bool keys = keys_are_reversed(scope.dataset());
        const std::string list = keys ? std::string() : stated_signs(scope, records, wrong.region, surfaces);
        if (!list.empty()) message += "; its list has " + list + ", which should have the other sign";
        Finding finding = finding_of("B30", std::move(message));
        if (keys) use_other_severity(finding);
        finding.entities.push_back({"region", wrong.name, wrong.region});
        name_surfaces_at(scope, surfaces, finding);
        finding.measures = {{"volume_as_stated", wrong.volume_as_stated}, {"volume", wrong.volume}};
        if (keys) finding.measures.emplace_back("reversed_keys", 1);
        findings.push_back(std::move(finding));
    }
    if (!claims.reversed_convention || !claims.wrong_sides.empty()) return;
    Finding finding = finding_of("B30", "the signs of all regions mean the other side: in front of a surface is stated as behind it");
    use_other_severity(finding);
    finding.entities.push_back({"model", scope.brep().name});
    finding.count = 1;
    finding.measures = {{"regions", static_cast<double>(scope.brep().regions.size())}};
    findings.push_back(std::move(finding));
}

void check_universe(const ModelScope& scope, std::vector<Finding>& findings) {
    const topology::StatedClaims& claims = scope.model().claims;
    const BrepData& brep = scope.brep();
    if (!claims.universe_stated || brep.regions.empty()) return;
    // Where the Universe closes and a region does not, the region is what is wrong (B05).
    const bool all_close = std::ranges::all_of(brep.regions, [](const auto& r) { return r.volume_known || !r.cell_types.empty(); });
    if (!all_close && closes(scope, claims.universe)) return;
    std::vector<std::uint8_t> inner(2 * brep.surfaces.size(), 0), outer(2 * brep.surfaces.size(), 0);
    for (const auto& region : brep.regions) mark_sides(region.sides, inner);
    mark_sides(claims.universe, outer);
    std::vector<std::uint32_t> missing, foreign, missing_sides, foreign_sides;
    for (std::uint32_t side = 0; side < inner.size(); ++side) {
        if (brep.surfaces[side / 2].polygons.size() == 0) continue;
        const bool bounds_outside = inner[side] == 0 && inner[side ^ 1u] != 0;
        if (bounds_outside && outer[side] == 0) missing_sides.push_back(side);
        if (inner[side] != 0 && outer[side] != 0) foreign_sides.push_back(side);
    }
    if (missing_sides.empty() && foreign_sides.empty()) return;
    for (const std::uint32_t side : missing_sides) missing.push_back(side / 2);
    for (const std::uint32_t side : foreign_sides) foreign.push_back(side / 2);
    const StatedRecords records(scope);
    std::string message = "the Universe is not what the regions leave: ";
    if (claims.universe.empty()) message += "it is stated without any surface";
    else if (!missing.empty()) message += "it lacks " + counted(missing.size(), "side", "sides") + ", " + records.sides_text(missing_sides);
    if (!foreign.empty())
        message += std::string(missing.empty() ? "" : ", and ") + "it has " + counted(foreign.size(), "side", "sides") +
                   " that a region has, " + records.sides_text(foreign_sides);
    Finding finding = finding_of("B31", std::move(message));
    finding.entities.push_back({"region", claims.universe_name, -1});
    missing.insert(missing.end(), foreign.begin(), foreign.end());
    std::ranges::sort(missing);
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    name_surfaces_at(scope, missing, finding);
    findings.push_back(std::move(finding));
}

}  // namespace geomend::validators
