// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "base/wording.h"
#include "validators/cell_findings.h"
#include "validators/model_checks.h"
#include "validators/surface_facing.h"

// Lists that contradict each other: along one horizon the same layer lies above in one place and below in another, or two fault blocks
// change sides along one fault.

namespace geomend::validators {

namespace {

/// The layers below and above a surface, and whether its normal points upwards.
struct Between {
    std::uint32_t below, above, surface;
    bool is_up;
};

/// Per region the number of the list that has it first, or no_index.
std::vector<std::uint32_t> lists_of_regions(const std::vector<BrepData::RegionList>& lists, std::size_t regions) {
    std::vector<std::uint32_t> list(regions, no_index);
    for (std::uint32_t l = 0; l < lists.size(); ++l) {
        for (const RegionId r : lists[l].regions) {
            if (list[r.value] == no_index) list[r.value] = l;
        }
    }
    return list;
}

/// Per stratigraphic interface what lies below and above its surfaces.
std::map<std::uint32_t, std::vector<Between>> layers_at_interfaces(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    const auto layer = lists_of_regions(brep.layers, brep.regions.size());
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

/// The fault blocks behind and before a surface of a fault, and its mean normal of length 1.
struct BlocksAtFault {
    std::uint32_t behind, before, surface;
    Vec3 normal;
};

/// Per fault what lies on the sides of its surfaces that part two fault blocks and are not bent too much to have two sides.
std::map<std::uint32_t, std::vector<BlocksAtFault>> blocks_at_faults(const ModelScope& scope) {
    constexpr double clearly = 0.5;  // of the area
    const BrepData& brep = scope.brep();
    const auto block = lists_of_regions(brep.fault_blocks, brep.regions.size());
    std::map<std::uint32_t, std::vector<BlocksAtFault>> all;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        if (surface.role != FeatureRole::fault || !surface.regions[0].valid() || !surface.regions[1].valid()) continue;
        const std::uint32_t behind = block[surface.regions[0].value], before = block[surface.regions[1].value];
        if (behind == no_index || before == no_index || behind == before) continue;
        const Facing facing = facing_of(scope, s);
        const double length = std::sqrt(dot(facing.normal, facing.normal));
        if (!(length > 0) || length < clearly * facing.area) continue;
        all[surface.interface_id.value].push_back({behind, before, s, times(1 / length, facing.normal)});
    }
    return all;
}

/// Whether two blocks have changed sides: surfaces that face one way have them the other way round.
bool change_sides(const BlocksAtFault& a, const BlocksAtFault& b) {
    constexpr double alike = 0.5;  // within 60 degrees
    const double turn = dot(a.normal, b.normal);
    if (turn > alike) return a.behind == b.before && a.before == b.behind;
    return turn < -alike && a.behind == b.behind && a.before == b.before;
}

Finding sides_finding(const ModelScope& scope, std::uint32_t interface, const BlocksAtFault& a, const BlocksAtFault& b) {
    const BrepData& brep = scope.brep();
    Finding finding = finding_of("G09", "fault blocks " + quoted(brep.fault_blocks[a.behind].name) + " and " +
                                            quoted(brep.fault_blocks[a.before].name) + " contradict each other at fault " +
                                            quoted(brep.interfaces[interface].name) + ": they have changed sides between " +
                                            quoted(brep.surfaces[a.surface].name) + " and " + quoted(brep.surfaces[b.surface].name));
    finding.entities = {{"interface", brep.interfaces[interface].name, interface}};
    for (const BlocksAtFault* one : {&a, &b}) {
        finding.entities.push_back(surface_ref(scope, one->surface));
        const auto& surface = brep.surfaces[one->surface];
        finding.points.push_back(scope.vertex_of_node(surface, surface.polygons[0][0]));
    }
    for (const std::uint32_t l : {a.behind, a.before}) finding.entities.push_back({"fault block", brep.fault_blocks[l].name, l});
    finding.count = 1;
    return finding;
}

/// At each fault the first contradiction to its first surface between two blocks.
void check_sides_of_blocks(const ModelScope& scope, std::vector<Finding>& findings) {
    for (const auto& [interface, all] : blocks_at_faults(scope)) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, const BlocksAtFault*> first;  // of two blocks
        for (const BlocksAtFault& one : all) {
            const auto [known, is_new] = first.try_emplace(std::minmax(one.behind, one.before), &one);
            if (is_new || !change_sides(*known->second, one)) continue;
            findings.push_back(sides_finding(scope, interface, *known->second, one));
            break;
        }
    }
}

/// Two blocks with a surface of a horizon between them that lie, each, on both sides of one fault: they are layers.
void check_parting_of_blocks(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const auto block = lists_of_regions(brep.fault_blocks, brep.regions.size());
    std::map<std::uint32_t, std::set<std::uint32_t>> within;                           // per fault the blocks on both sides of it
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> horizon_between;  // surface, of two blocks
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        if (!surface.regions[0].valid() || !surface.regions[1].valid() || surface.regions[0] == surface.regions[1]) continue;
        const std::uint32_t a = block[surface.regions[0].value], b = block[surface.regions[1].value];
        if (a == no_index || b == no_index) continue;
        if (surface.role == FeatureRole::fault && a == b) within[surface.interface_id.value].insert(a);
        if (surface.role == FeatureRole::horizon && a != b) horizon_between.try_emplace(std::minmax(a, b), s);
    }
    for (const auto& [blocks, s] : horizon_between) {
        const auto has_both = [&](const auto& fault) {
            return fault.second.contains(blocks.first) && fault.second.contains(blocks.second);
        };
        const auto fault = std::ranges::find_if(within, has_both);
        if (fault == within.end()) continue;
        const std::string& name = brep.interfaces[fault->first].name;
        Finding finding = finding_of("G09", "fault blocks " + quoted(brep.fault_blocks[blocks.first].name) + " and " +
                                                quoted(brep.fault_blocks[blocks.second].name) + " both lie on both sides of fault " +
                                                quoted(name) + ", and horizon " + quoted(brep.surfaces[s].name) + " parts them");
        finding.entities = {{"interface", name, fault->first}, surface_ref(scope, s)};
        for (const std::uint32_t l : {blocks.first, blocks.second})
            finding.entities.push_back({"fault block", brep.fault_blocks[l].name, l});
        finding.points.push_back(scope.vertex_of_node(brep.surfaces[s], brep.surfaces[s].polygons[0][0]));
        finding.count = 1;
        findings.push_back(std::move(finding));
    }
}

}  // namespace

void check_layer_lists(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    if (brep.fault_blocks.size() > 1) {
        check_sides_of_blocks(scope, findings);
        check_parting_of_blocks(scope, findings);
    }
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
