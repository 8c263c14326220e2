// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/connected_surfaces.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "model/attribute_operations.h"

namespace geomend::exchange {

namespace {

bool is_at_cells(const BrepData& brep, const BrepData::Surface& surface) {
    return std::ranges::any_of(surface.regions, [&](RegionId r) {
        return r.valid() && r.value < brep.regions.size() && !brep.regions[r.value].cell_types.empty();
    });
}

/// The polygons of each part, by its first one.
std::vector<std::vector<std::uint32_t>> parts_of(const BrepData::Surface& surface) {
    DisjointSets joined(surface.polygons.size());
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
        const std::size_t first = surface.polygons.first_corner(p);
        for (std::size_t i = first; i < first + surface.polygons[p].size() && i < surface.neighbours.size(); ++i) {
            if (surface.neighbours[i] != no_index) joined.join(p, surface.neighbours[i]);
        }
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> of_root;
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) of_root[joined.root(p)].push_back(p);
    std::vector<std::vector<std::uint32_t>> parts;
    for (auto& [root, polygons] : of_root) parts.push_back(std::move(polygons));
    return parts;
}

/// Some polygons of a surface as a surface, with the nodes that they use.
BrepData::Surface part_of(const BrepData::Surface& whole, const std::vector<std::uint32_t>& polygons, std::size_t number) {
    BrepData::Surface part;
    part.name = number == 0 || whole.name.empty() ? whole.name : whole.name + "_" + std::to_string(number + 1);
    part.interface_id = whole.interface_id;
    part.role = whole.role;
    part.role_text = whole.role_text;
    part.lines = whole.lines;
    part.regions = whole.regions;
    part.source_object = whole.source_object;
    part.source_part = whole.source_part;
    part.annotations = whole.annotations;
    std::vector<std::uint32_t> nodes, number_of(whole.nodes.size(), no_index), place_of(whole.polygons.size(), no_index), polygon;
    for (std::uint32_t p = 0; p < polygons.size(); ++p) {
        place_of[polygons[p]] = p;
        polygon.clear();
        for (const std::uint32_t node : whole.polygons[polygons[p]]) {
            if (number_of[node] == no_index) {
                number_of[node] = static_cast<std::uint32_t>(nodes.size());
                nodes.push_back(node);
            }
            polygon.push_back(number_of[node]);
        }
        part.polygons.push_back(polygon);
    }
    for (const std::uint32_t p : polygons) {
        const std::size_t first = whole.polygons.first_corner(p);
        for (std::size_t i = first; i < first + whole.polygons[p].size(); ++i)
            part.neighbours.push_back(whole.neighbours[i] == no_index ? no_index : place_of[whole.neighbours[i]]);
    }
    for (const std::uint32_t node : nodes) part.nodes.push_back(whole.nodes[node]);
    for (const Attribute& a : whole.attributes) {
        if (a.location == AttributeLocation::point) part.attributes.push_back(taken(a, nodes));
        else if (a.location == AttributeLocation::polygon) part.attributes.push_back(taken(a, polygons));
        else part.attributes.push_back(a);
    }
    return part;
}

using Ranges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // per surface its parts: first, end

std::vector<SurfaceId> expanded(const std::vector<SurfaceId>& surfaces, const Ranges& parts) {
    std::vector<SurfaceId> all;
    for (const SurfaceId s : surfaces) {
        for (std::uint32_t part = parts[s.value].first; part != parts[s.value].second; ++part) all.emplace_back(part);
    }
    return all;
}

std::vector<BrepData::Side> expanded(const std::vector<BrepData::Side>& sides, const Ranges& parts) {
    std::vector<BrepData::Side> all;
    for (const BrepData::Side& side : sides) {
        const auto [first, end] = parts[side.surface.value];
        for (std::uint32_t part = first; part != end; ++part) all.push_back({SurfaceId(part), side.front});
    }
    return all;
}

}  // namespace

std::optional<BrepData> with_connected_surfaces(const BrepData& brep) {
    std::vector<std::vector<std::vector<std::uint32_t>>> parts(brep.surfaces.size());
    bool any = false;
    for (std::size_t s = 0; s < parts.size(); ++s) {
        const BrepData::Surface& surface = brep.surfaces[s];
        if (!is_at_cells(brep, surface) || surface.neighbours.size() != surface.polygons.corners.size()) continue;
        parts[s] = parts_of(surface);
        any |= parts[s].size() > 1;
    }
    if (!any) return std::nullopt;
    BrepData made = brep;
    made.surfaces.clear();
    Ranges ranges;
    for (std::size_t s = 0; s < parts.size(); ++s) {
        const auto first = static_cast<std::uint32_t>(made.surfaces.size());
        if (parts[s].size() < 2) made.surfaces.push_back(brep.surfaces[s]);
        else
            for (std::size_t k = 0; k < parts[s].size(); ++k) made.surfaces.push_back(part_of(brep.surfaces[s], parts[s][k], k));
        ranges.emplace_back(first, static_cast<std::uint32_t>(made.surfaces.size()));
    }
    for (auto& interface : made.interfaces) interface.surfaces = expanded(interface.surfaces, ranges);
    for (auto& feature : made.features) feature.surfaces = expanded(feature.surfaces, ranges);
    for (auto& region : made.regions) region.sides = expanded(region.sides, ranges);
    made.universe = expanded(made.universe, ranges);
    return made;
}

}  // namespace geomend::exchange
