// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/cell_volume.h"
#include "validators/cell_findings.h"
#include "validators/each_surface.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

/// A name, and how many things have it.
Finding names_finding(std::string_view code, std::string message, std::vector<EntityRef> things) {
    Finding finding = finding_of(code, std::move(message));
    finding.count = things.size();
    finding.element_kind = things[0].kind;
    things.resize(std::min(things.size(), listed_elements));
    finding.entities = std::move(things);
    return finding;
}

std::string in_lower_case(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

using Things = std::map<std::string, std::vector<EntityRef>>;

/// The things of one kind that have names of their own, by name.
Things regions_by_name(const ModelScope& scope) {
    Things all;
    for (std::uint32_t r = 0; r < scope.brep().regions.size(); ++r) all[scope.brep().regions[r].name].push_back(region_ref(scope, r));
    return all;
}
Things interfaces_by_name(const ModelScope& scope) {
    Things all;
    const auto& interfaces = scope.brep().interfaces;
    for (std::uint32_t i = 0; i < interfaces.size(); ++i) all[interfaces[i].name].push_back({"interface", interfaces[i].name, i});
    return all;
}
Things lists_by_name(std::span<const BrepData::RegionList> lists, const char* kind) {
    Things all;
    for (const auto& list : lists) all[list.name].push_back({kind, list.name});
    return all;
}
/// Objects whose surfaces were put into one interface because they have one name. Where a model is stated, it says which
/// objects make one surface.
Things surface_objects_by_name(const ModelScope& scope) {
    if (scope.model().stated) return {};
    std::map<std::string, std::set<std::uint32_t>> objects;
    for (const auto& surface : scope.brep().surfaces) {
        if (surface.source_object >= scope.dataset().objects.size() || !surface.interface_id.valid()) continue;
        const Object& object = scope.dataset().objects[surface.source_object];
        const std::string& name = info_of(object).name;
        if (std::holds_alternative<Surface>(object) && name == scope.brep().interfaces[surface.interface_id.value].name)
            objects[name].insert(surface.source_object);
    }
    Things all;
    for (const auto& [name, numbers] : objects) all[name].assign(numbers.size(), {"surface", name});
    return all;
}

void tell_repeats(const Things& things, std::string_view many, std::vector<Finding>& findings) {
    for (const auto& [name, all] : things) {
        if (all.size() < 2 || name.empty()) continue;
        findings.push_back(names_finding("G01", std::to_string(all.size()) + " " + std::string(many) + " are named " + quoted(name), all));
    }
}

/// Whether the file states one group of volumes of a name (a physical group of MSH): its parts are meant to have that name.
bool is_one_group(const ModelScope& scope, std::uint32_t region) {
    const auto& r = scope.brep().regions[region];
    if (r.source_object >= scope.dataset().objects.size()) return false;
    const auto* mesh = std::get_if<CellMesh>(&scope.dataset().objects[r.source_object]);
    if (mesh == nullptr) return false;
    return std::ranges::count_if(mesh->groups, [&](const CellMesh::Group& g) { return g.dimension == 3 && g.name == r.name; }) == 1;
}

void tell_case_only(const Things& things, std::string_view many, std::vector<Finding>& findings) {
    std::map<std::string, std::vector<EntityRef>> alike;
    for (const auto& [name, all] : things) alike[in_lower_case(name)].push_back(all[0]);
    for (auto& [name, all] : alike) {
        if (all.size() < 2) continue;
        const std::string both = quoted(all[0].name) + " and " + quoted(all[1].name);
        findings.push_back(
            names_finding("G06", "names of " + std::string(many) + " differ in upper and lower case only: " + both, std::move(all)));
    }
}

}  // namespace

void check_names_of_model(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const Things regions = regions_by_name(scope), interfaces = interfaces_by_name(scope);
    const Things layers = lists_by_name(brep.layers, "layer"), blocks = lists_by_name(brep.fault_blocks, "fault block");
    tell_repeats(regions, "regions", findings);
    for (Finding& finding : findings) {
        const bool repeat = finding.code == "G01" && finding.element_kind == "region";
        if (repeat && is_one_group(scope, static_cast<std::uint32_t>(finding.entities[0].id))) {
            use_other_severity(finding);
            finding.message += ", as parts of one group";
        }
    }
    tell_repeats(layers, "layers", findings);
    tell_repeats(blocks, "fault blocks", findings);
    tell_repeats(surface_objects_by_name(scope), "surface objects, treated as one surface,", findings);
    tell_case_only(regions, "regions", findings);
    tell_case_only(interfaces, "surfaces", findings);
    tell_case_only(layers, "layers", findings);
    tell_case_only(blocks, "fault blocks", findings);
    // A layer is often named like its only region; a surface is something else.
    for (const auto& [name, all] : interfaces) {
        const auto region = regions.find(name);
        if (name.empty() || region == regions.end()) continue;
        findings.push_back(names_finding("G08", quoted(name) + " names a surface and a region", {all[0], region->second[0]}));
    }
}

void check_region_lists(const ModelScope& scope, std::vector<Finding>& findings) {
    const auto judge = [&](const std::vector<BrepData::RegionList>& lists, const char* kind) {
        for (const auto& list : lists) {
            if (!list.regions.empty()) continue;
            Finding finding = finding_of("G02", std::string(kind) + " " + quoted(list.name) + " has no region");
            finding.entities.push_back({kind, list.name});
            finding.count = 1;
            findings.push_back(std::move(finding));
        }
    };
    judge(scope.brep().layers, "layer");
    judge(scope.brep().fault_blocks, "fault block");
}

void check_list_members(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const auto judge = [&](const std::vector<BrepData::RegionList>& lists, const char* kind) {
        if (lists.empty()) return;
        std::vector<std::set<std::string>> lists_of(brep.regions.size());
        for (const auto& list : lists) {
            for (const RegionId r : list.regions) lists_of[r.value].insert(list.name);
        }
        std::vector<EntityRef> several, none;
        for (std::uint32_t r = 0; r < lists_of.size(); ++r) {
            if (lists_of[r].size() > 1) several.push_back(region_ref(scope, r));
            if (lists_of[r].empty()) none.push_back(region_ref(scope, r));
        }
        if (!several.empty()) {
            const std::string first = quoted(several[0].name) + " in " +
                                      quoted(*lists_of[static_cast<std::size_t>(several[0].id)].begin()) + " and " +
                                      quoted(*std::next(lists_of[static_cast<std::size_t>(several[0].id)].begin()));
            findings.push_back(names_finding(
                "G07", counted(several.size(), "region is", "regions are") + " in more than one " + kind + ": " + first, several));
        }
        if (!none.empty()) {
            findings.push_back(names_finding("G07",
                                             counted(none.size(), "region is", "regions are") + " in no " + kind + ", although " +
                                                 counted(lists.size(), "is", "are") + " stated: " + quoted(none[0].name),
                                             none));
            use_other_severity(findings.back());
        }
    };
    judge(brep.layers, "layer");
    judge(brep.fault_blocks, "fault block");
}

void check_fault_displacement(const ModelScope& scope, std::vector<Finding>& findings) {
    // Where a horizon is not displaced it comes up to a line of the fault from both sides, and the fault goes on beyond: one
    // that ends at a horizon was there before it, and says nothing.
    const BrepData& brep = scope.brep();
    std::vector<std::map<std::uint32_t, unsigned>> horizons_at(brep.lines.size());
    std::vector<std::map<std::uint32_t, unsigned>> faults_at(brep.lines.size());
    for (const auto& surface : brep.surfaces) {
        for (const auto& use : surface.lines) {
            if (is_stratigraphic(surface.role)) ++horizons_at[use.line.value][surface.interface_id.value];
            if (surface.role == FeatureRole::fault) ++faults_at[use.line.value][surface.interface_id.value];
        }
    }
    struct Contacts {
        unsigned displaced = 0, straight = 0;
        std::vector<std::uint32_t> lines;
    };
    std::map<std::uint32_t, Contacts> of_fault;
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        for (const auto& [fault, pieces] : faults_at[l]) {
            for (const auto& [horizon, count] : horizons_at[l]) {
                Contacts& contacts = of_fault[fault];
                if (count < 2) {
                    ++contacts.displaced;
                } else if (pieces >= 2) {
                    ++contacts.straight;
                    contacts.lines.push_back(l);
                }
            }
        }
    }
    for (const auto& [fault, contacts] : of_fault) {
        if (contacts.straight == 0 || contacts.displaced > 0) continue;
        Finding finding = finding_of("G03", "fault " + quoted(brep.interfaces[fault].name) + " has no throw: at " +
                                                counted(contacts.straight, "contact", "contacts") + " the horizon goes straight through");
        finding.entities.push_back({"interface", brep.interfaces[fault].name, fault});
        finding.count = contacts.straight;
        finding.element_kind = "line";
        for (const std::uint32_t l : contacts.lines) mark_line(scope, l, finding);
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
