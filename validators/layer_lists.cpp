// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "validators/cell_findings.h"
#include "validators/model_checks.h"
#include "validators/surface_facing.h"

// Lists of layers that contradict each other: along one horizon the same layer lies above in one place and below in another.

namespace geomend::validators {

namespace {

/// The layers below and above a surface, and whether its normal points upwards.
struct Between {
    std::uint32_t below, above, surface;
    bool is_up;
};

/// Per region the layer that lists it first, or no_index.
std::vector<std::uint32_t> layers_of_regions(const BrepData& brep) {
    std::vector<std::uint32_t> layer(brep.regions.size(), no_index);
    for (std::uint32_t l = 0; l < brep.layers.size(); ++l) {
        for (const RegionId r : brep.layers[l].regions) {
            if (layer[r.value] == no_index) layer[r.value] = l;
        }
    }
    return layer;
}

/// Per stratigraphic interface what lies below and above its surfaces.
std::map<std::uint32_t, std::vector<Between>> layers_at_interfaces(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    const auto layer = layers_of_regions(brep);
    std::map<std::uint32_t, std::vector<Between>> all;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        if (!is_stratigraphic(surface.role) || !surface.regions[0].valid() || !surface.regions[1].valid()) continue;
        const std::uint32_t behind = layer[surface.regions[0].value], before = layer[surface.regions[1].value];
        if (behind == no_index || before == no_index) continue;
        const Facing facing = facing_of(scope, s);
        if (!looks_up_or_down(facing)) continue;
        const bool is_up = facing.normal[2] > 0;
        all[surface.interface_id.value].push_back({is_up ? behind : before, is_up ? before : behind, s, is_up});
    }
    return all;
}

/// Whether what is said of two surfaces of one horizon cannot both be: a layer is above it here and below it there, or it parts
/// two layers here and lies within one of them there.
bool contradict(const Between& a, const Between& b) {
    const bool a_parts = a.below != a.above, b_parts = b.below != b.above;
    if (a_parts && b_parts) return a.above == b.below || a.below == b.above;
    if (a_parts) return b.below == a.below || b.below == a.above;
    return b_parts && (a.below == b.below || a.below == b.above);
}

std::string text_of(const BrepData& brep, const Between& b) {
    const std::string name = quoted(brep.surfaces[b.surface].name);
    if (b.below == b.above) return quoted(brep.layers[b.below].name) + " on both sides of " + name;
    return quoted(brep.layers[b.above].name) + " above " + quoted(brep.layers[b.below].name) + " at " + name;
}

/// The first surface for each way in which layers lie at a horizon.
std::vector<Between> ways_of(const std::vector<Between>& all) {
    std::vector<Between> ways;
    std::set<std::tuple<std::uint32_t, std::uint32_t, bool>> seen;
    for (const Between& b : all) {
        if (seen.emplace(b.below, b.above, b.is_up).second) ways.push_back(b);
    }
    return ways;
}

}  // namespace

void check_layer_lists(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    if (brep.layers.size() < 2) return;
    for (const auto& [interface, all] : layers_at_interfaces(scope)) {
        const auto ways = ways_of(all);
        const Between *first = nullptr, *second = nullptr;
        bool surely = false;
        for (std::size_t i = 0; i < ways.size() && !surely; ++i) {
            for (std::size_t j = 0; j < i && !surely; ++j) {
                if (!contradict(ways[j], ways[i])) continue;
                first = &ways[j];
                second = &ways[i];
                // Overturned, both the layers and the normal of the horizon are upside down.
                surely = first->is_up == second->is_up || first->below == first->above || second->below == second->above;
            }
        }
        if (first == nullptr) continue;
        Finding finding = finding_of("G09", "the layers on the two sides of horizon " + quoted(brep.interfaces[interface].name) +
                                                " contradict each other: " + text_of(brep, *first) + ", but " + text_of(brep, *second));
        if (!surely) {
            use_other_severity(finding);
            finding.message += ": right only if layers are overturned there, as normals say that point the other way";
        }
        finding.entities = {{"interface", brep.interfaces[interface].name, interface}};
        for (const Between* b : {first, second}) {
            finding.entities.push_back(surface_ref(scope, b->surface));
            for (const std::uint32_t l : {b->below, b->above}) finding.entities.push_back({"layer", brep.layers[l].name, l});
            const auto& surface = brep.surfaces[b->surface];
            finding.points.push_back(scope.vertex_of_node(surface, surface.polygons[0][0]));
        }
        finding.count = 1;
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
