// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/cell_volume.h"
#include "validators/each_surface.h"
#include "validators/found_cells.h"
#include "validators/model_checks.h"

namespace geomend::validators {

namespace {

/// Twice the area of a surface as a vector along its mean normal, and without regard to direction.
struct Facing {
    Vec3 normal{};
    double area = 0;
};

Facing facing_of(const ModelScope& scope, std::uint32_t s) {
    Facing facing;
    for (std::uint32_t t = scope.first_triangle(s); t < scope.first_triangle(s + 1); ++t) {
        const auto& [a, b, c] = scope.triangles()[t];
        const auto& v = scope.brep().vertices;
        const Vec3 n = cross(minus(v[b], v[a]), minus(v[c], v[a]));
        for (std::size_t k = 0; k < 3; ++k) facing.normal[k] += n[k];
        facing.area += std::sqrt(dot(n, n));
    }
    return facing;
}

}  // namespace

void check_region_names(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::map<std::string, std::vector<std::uint32_t>> by_name;
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) by_name[brep.regions[r].name].push_back(r);
    for (const auto& [name, regions] : by_name) {
        if (regions.size() < 2) continue;
        Finding finding = finding_of("G01", std::to_string(regions.size()) + " regions are named " + quoted(name));
        for (const std::uint32_t r : regions) {
            if (finding.entities.size() < listed_elements) finding.entities.push_back(region_ref(scope, r));
        }
        finding.count = regions.size();
        finding.element_kind = "region";
        findings.push_back(std::move(finding));
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

void check_fault_displacement(const ModelScope& scope, std::vector<Finding>& findings) {
    // Where a horizon is not displaced it comes up to a line of the fault from both sides.
    const BrepData& brep = scope.brep();
    std::vector<std::map<std::uint32_t, unsigned>> horizons_at(brep.lines.size());
    std::vector<std::set<std::uint32_t>> faults_at(brep.lines.size());
    for (const auto& surface : brep.surfaces) {
        for (const auto& use : surface.lines) {
            if (is_stratigraphic(surface.role)) ++horizons_at[use.line.value][surface.interface_id.value];
            if (surface.role == FeatureRole::fault) faults_at[use.line.value].insert(surface.interface_id.value);
        }
    }
    struct Contacts {
        unsigned displaced = 0, straight = 0;
        std::vector<std::uint32_t> lines;
    };
    std::map<std::uint32_t, Contacts> of_fault;
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        for (const std::uint32_t fault : faults_at[l]) {
            for (const auto& [horizon, count] : horizons_at[l]) {
                Contacts& contacts = of_fault[fault];
                if (count >= 2) {
                    ++contacts.straight;
                    contacts.lines.push_back(l);
                } else {
                    ++contacts.displaced;
                }
            }
        }
    }
    for (const auto& [fault, contacts] : of_fault) {
        if (contacts.straight == 0 || contacts.displaced > 0) continue;
        Finding finding = finding_of("G03", "fault " + quoted(brep.interfaces[fault].name) + " displaces no horizon: at " +
                                                counted(contacts.straight, "contact", "contacts") + " the horizon goes straight through");
        finding.entities.push_back({"interface", brep.interfaces[fault].name, fault});
        finding.count = contacts.straight;
        finding.element_kind = "line";
        for (const std::uint32_t l : contacts.lines) mark_line(scope, l, finding);
        findings.push_back(std::move(finding));
    }
}

void check_horizon_order(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    constexpr double clearly = 0.3;  // of the area: a surface that is neither roof nor floor of a region says nothing
    std::vector<Facing> facing(brep.surfaces.size());
    parallel_for_each_index(facing.size(), [&](std::size_t s) {
        if (is_stratigraphic(brep.surfaces[s].role)) facing[s] = facing_of(scope, static_cast<std::uint32_t>(s));
    });
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> above;  // (roof, floor) -> a region between them
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        std::set<std::uint32_t> roofs, floors;
        for (const auto& side : brep.regions[r].sides) {
            const auto& surface = brep.surfaces[side.surface.value];
            const Facing& f = facing[side.surface.value];
            if (f.area == 0 || std::abs(f.normal[2]) < clearly * f.area) continue;
            (side.front == (f.normal[2] > 0) ? floors : roofs).insert(surface.interface_id.value);
        }
        for (const std::uint32_t roof : roofs) {
            for (const std::uint32_t floor : floors) {
                if (roof != floor) above.emplace(std::pair{roof, floor}, r);
            }
        }
    }
    for (const auto& [pair, region] : above) {
        const auto reverse = above.find({pair.second, pair.first});
        if (reverse == above.end() || pair.first > pair.second) continue;
        Finding finding = finding_of(
            "G04", quoted(brep.interfaces[pair.first].name) + " lies above " + quoted(brep.interfaces[pair.second].name) + " in region " +
                       quoted(brep.regions[region].name) + " and below it in region " + quoted(brep.regions[reverse->second].name));
        finding.entities = {{"interface", brep.interfaces[pair.first].name, pair.first},
                            {"interface", brep.interfaces[pair.second].name, pair.second},
                            region_ref(scope, region),
                            region_ref(scope, reverse->second)};
        finding.count = 1;
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
