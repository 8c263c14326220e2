// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/geology.h"

#include <algorithm>
#include <map>

namespace geomend::topology {

BrepData::Interface& InterfaceBook::enter(SurfaceId surface, const std::string& name) {
    const auto [at, is_new] = known_.emplace(name, InterfaceId(brep_.interfaces.size()));
    if (is_new) brep_.interfaces.push_back({name, FeatureRole::unknown, {}, {}, {}, {}});
    auto* found = &brep_.interfaces[at->second.value];
    found->surfaces.push_back(surface);
    auto& s = brep_.surfaces[surface.value];
    s.interface_id = at->second;
    if (found->role == FeatureRole::unknown) found->role = s.role;
    if (found->role_text.empty()) found->role_text = s.role_text;
    return *found;
}

InterfaceId InterfaceBook::find(const std::string& name) const {
    const auto found = known_.find(name);
    return found == known_.end() ? InterfaceId() : found->second;
}

void name_surfaces(BrepData& brep) {
    for (const auto& interface : brep.interfaces) {
        for (std::size_t i = 0; i < interface.surfaces.size(); ++i) {
            auto& name = brep.surfaces[interface.surfaces[i].value].name;
            if (name.empty()) name = interface.surfaces.size() == 1 ? interface.name : interface.name + "_" + std::to_string(i + 1);
        }
    }
}

void make_contacts(BrepData& brep) {
    std::vector<std::vector<InterfaceId>> around(brep.lines.size());
    for (const auto& surface : brep.surfaces) {
        for (const auto& use : surface.lines) around[use.line.value].push_back(surface.interface_id);
    }
    std::map<std::vector<InterfaceId>, ContactId> known;
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        auto& interfaces = around[l];
        std::sort(interfaces.begin(), interfaces.end());
        interfaces.erase(std::unique(interfaces.begin(), interfaces.end()), interfaces.end());
        if (interfaces.empty()) continue;  // a line away from all surfaces
        const auto [at, is_new] = known.emplace(interfaces, ContactId(brep.contacts.size()));
        if (is_new) {
            BrepData::Contact contact;
            for (const InterfaceId i : interfaces) contact.name += (contact.name.empty() ? "" : "|") + brep.interfaces[i.value].name;
            contact.interfaces = interfaces;
            brep.contacts.push_back(std::move(contact));
        }
        brep.contacts[at->second.value].lines.emplace_back(l);
        brep.lines[l].contact = at->second;
    }
}

void count_internal_lines(BrepData& brep) {
    std::vector<std::uint8_t> ends_region(brep.lines.size(), 0), inside_surface(brep.lines.size(), 0), in_region(brep.lines.size(), 0);
    for (const auto& surface : brep.surfaces) {
        const bool internal = surface.regions[0].valid() && surface.regions[0] == surface.regions[1];
        for (const auto& use : surface.lines) {
            (internal ? in_region : ends_region)[use.line.value] = 1;
            if (use.internal) inside_surface[use.line.value] = 1;
        }
    }
    brep.internal_lines_of_regions = brep.internal_lines_of_surfaces = 0;
    for (std::size_t l = 0; l < brep.lines.size(); ++l) {
        if (in_region[l] != 0 && ends_region[l] == 0) ++brep.internal_lines_of_regions;
        if (inside_surface[l] != 0) ++brep.internal_lines_of_surfaces;
    }
}

}  // namespace geomend::topology
