// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/regions_of_complex.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/parallel.h"
#include "topology/cell_regions.h"
#include "topology/face_volume.h"
#include "topology/keys.h"
#include "topology/unsigned_lists.h"

namespace geomend::topology {

namespace {

constexpr std::size_t most_listed = 100;

bool was_reported(const SurfaceComplex& complex, const char* code) {
    return std::ranges::find(complex.reported, code) != complex.reported.end();
}

void report_keys(const SurfaceComplex& complex, const char* code, std::string message, const std::vector<std::uint32_t>& surfaces,
                 Assembly& a) {
    if (surfaces.empty() || was_reported(complex, code)) return;
    Finding finding = make_finding(code, std::to_string(surfaces.size()) + std::move(message), {}, surfaces.size());
    finding.element_kind = "surface";
    for (std::size_t i = 0; i < surfaces.size() && i < most_listed; ++i) {
        finding.entities.push_back({"surface", a.brep.surfaces[surfaces[i]].name, surfaces[i]});
        finding.elements.push_back(complex.faces[surfaces[i]].number);
        finding.index.push_back(surfaces[i]);
    }
    a.findings.push_back(std::move(finding));
}

/// Per face whether its key triangle is reversed against its surface.
std::vector<std::uint8_t> reversed_keys(const SurfaceComplex& complex, Assembly& a) {
    std::vector<KeyMatch> match(complex.faces.size(), KeyMatch::same);
    parallel_for_each_index(match.size(), [&](std::size_t f) {
        if (complex.faces[f].key) match[f] = match_key(a.brep.surfaces[f], *complex.faces[f].key);
    });
    std::vector<std::uint32_t> reversed, absent;
    std::vector<std::uint8_t> result(match.size(), 0);
    for (std::uint32_t f = 0; f < match.size(); ++f) {
        if (match[f] == KeyMatch::reversed) reversed.push_back(f);
        if (match[f] == KeyMatch::absent) absent.push_back(f);
        result[f] = match[f] == KeyMatch::reversed ? 1 : 0;
    }
    report_keys(complex, "F106", " surfaces have a key triangle that is reversed against them", reversed, a);
    report_keys(complex, "F116", " surfaces have a key triangle that is not among their triangles", absent, a);
    return result;
}

/// The stated regions with sides as the surfaces are wound.
std::vector<StatedRegion> stated_regions(const SurfaceComplex& complex, std::span<const std::uint8_t> key_reversed) {
    std::vector<StatedRegion> regions = complex.regions;
    for (auto& region : regions) {
        for (auto& side : region.sides) side.front = side.front != (key_reversed[side.surface.value] != 0);
    }
    return regions;
}

/// Tells of layers that list the Universe, which is outside of the model. Gocad does so with the fault block of what is in none.
void report_universe_in_layers(const SurfaceComplex& complex, Assembly& a) {
    for (const auto& layer : complex.layers) {
        const auto is_outside = [&](std::uint32_t r) { return r < complex.regions.size() && complex.regions[r].universe; };
        const auto found = std::ranges::find_if(layer.regions, is_outside);
        if (found == layer.regions.end()) continue;
        const std::string& universe = complex.regions[*found].name;
        Finding finding = make_finding(
            "F113", "layer '" + layer.name + "' lists region '" + universe + "', which is the outside of the model: it is left out", {}, 1);
        finding.entities = {{"layer", layer.name, -1}, {"region", universe, -1}};
        a.findings.push_back(std::move(finding));
    }
}

/// Layers and fault blocks over the regions that there are.
/// \param ids per stated region its id, if it has one
void make_lists(const SurfaceComplex& complex, const std::vector<RegionId>& ids, Assembly& a) {
    std::vector<std::int64_t> missing;
    const auto resolve = [&](const std::vector<SurfaceComplex::RegionList>& from, std::vector<BrepData::RegionList>& to) {
        for (const auto& list : from) {
            BrepData::RegionList resolved{list.name, {}, list.unresolved};
            for (const std::uint32_t r : list.regions) {
                if (r < ids.size() && ids[r].valid()) resolved.regions.push_back(ids[r]);
            }
            missing.insert(missing.end(), list.unresolved.begin(), list.unresolved.end());
            to.push_back(std::move(resolved));
        }
    };
    resolve(complex.layers, a.brep.layers);
    resolve(complex.fault_blocks, a.brep.fault_blocks);
    report_universe_in_layers(complex, a);
    if (missing.empty() || was_reported(complex, "F109")) return;
    Finding finding = make_finding("F109", "layers or fault blocks list " + std::to_string(missing.size()) + " numbers without a region",
                                   {}, missing.size());
    finding.element_kind = "region";
    missing.resize(std::min(missing.size(), most_listed));
    finding.elements = std::move(missing);
    a.findings.push_back(std::move(finding));
}

void report_partial(std::vector<SurfaceId> partial, Assembly& a) {
    std::sort(partial.begin(), partial.end());
    partial.erase(std::unique(partial.begin(), partial.end()), partial.end());
    if (partial.empty()) return;
    const std::string first = "'" + a.brep.surfaces[partial[0].value].name + "'";
    const std::string message = partial.size() == 1 ? "surface " + first + " bounds a region with a part of its polygons only"
                                                    : std::to_string(partial.size()) +
                                                          " surfaces bound a region with a part of their polygons only: " + first + ", ...";
    Finding finding = make_finding("F113", message, {}, partial.size());
    finding.element_kind = "surface";
    finding.measures = {{"partial_surfaces", static_cast<double>(partial.size())}};
    for (std::size_t i = 0; i < partial.size() && i < most_listed; ++i) {
        finding.entities.push_back({"surface", a.brep.surfaces[partial[i].value].name, partial[i].value});
    }
    a.findings.push_back(std::move(finding));
}

/// Regions of the cells of volumes, mesh by mesh.
void add_filled_regions(const SurfaceComplex& complex, const std::vector<std::uint32_t>& filled, std::vector<RegionId>& region_of,
                        Assembly& a) {
    std::vector<CellRegion> made(filled.size());
    for (std::uint32_t m = 0; m < complex.meshes.size(); ++m) {
        const CellRegions maker(a.brep, *complex.meshes[m].mesh, complex.meshes[m].vertex_of);
        parallel_for_each_index(filled.size(), [&](std::size_t i) {
            const auto& volume = complex.volumes[filled[i]];
            if (volume.mesh == m) made[i] = maker.make(volume.cells);
        });
    }
    std::vector<SurfaceId> partial;
    for (std::size_t i = 0; i < filled.size(); ++i) {
        const auto& volume = complex.volumes[filled[i]];
        region_of[filled[i]] = RegionId(a.brep.regions.size());
        made[i].region.name = volume.boundary.name;
        made[i].region.source_object = complex.meshes[volume.mesh].object;
        partial.insert(partial.end(), made[i].incomplete.begin(), made[i].incomplete.end());
        a.brep.regions.push_back(std::move(made[i].region));
    }
    report_partial(std::move(partial), a);
}

/// Compares what is stated of regions (one side each, or whole lists) with the regions of the cells.
/// \return per stated region the one of its name
std::vector<RegionId> compare_regions(const std::vector<StatedRegion>& stated, const std::vector<RegionId>& region_of, Assembly& a) {
    std::multimap<std::string, RegionId> by_name;  // regions of one name are in the order of their statements
    for (const RegionId r : region_of) {
        if (r.valid()) by_name.emplace(a.brep.regions[r.value].name, r);
    }
    std::vector<RegionId> ids;
    std::map<std::string, std::ptrdiff_t> seen;
    for (const auto& list : stated) {
        const auto [first, last] = by_name.equal_range(list.name);
        if (first == last) {
            ids.emplace_back();
            continue;
        }
        auto& taken = seen[list.name];
        const auto found = std::next(first, std::min(taken++, std::distance(first, last) - 1));
        ids.push_back(found->second);
        if (list.universe) continue;
        const auto& sides = a.brep.regions[found->second.value].sides;
        const auto absent = std::ranges::find_if(list.sides, [&](const auto& side) {
            return std::ranges::none_of(sides, [&](const auto& s) { return s.surface == side.surface && s.front == side.front; });
        });
        if (absent == list.sides.end()) continue;
        const auto wrong = std::ranges::find_if(sides, [&](const auto& s) { return s.surface == absent->surface; });
        if (wrong != sides.end()) {
            a.claims.wrong_sides.push_back({list.name, found->second.value, {absent->surface}, 0, 0});
            continue;
        }
        const std::string& surface = a.brep.surfaces[absent->surface.value].name;
        auto finding = region_finding(a.brep, "F113", list.name,
                                      "region '" + list.name + "' is stated " + (absent->front ? "in front of '" : "behind '") + surface +
                                          "', but its cells are not there");
        finding.entities.push_back({"surface", surface, absent->surface.value});
        finding.measures = {{"sides_without_cells", 1}};
        a.findings.push_back(std::move(finding));
    }
    return ids;
}

/// Whether a volume of a mesh names one of its surfaces with a minus.
bool has_a_sign(const StatedRegion& region) {
    return std::ranges::any_of(region.sides, [](const BrepData::Side& side) { return side.front; });
}

void regions_from_volumes(const SurfaceComplex& complex, const std::vector<StatedRegion>& stated, Assembly& a) {
    std::vector<std::uint32_t> filled, hollow;
    for (std::uint32_t v = 0; v < complex.volumes.size(); ++v) (complex.volumes[v].cells.empty() ? hollow : filled).push_back(v);
    std::vector<RegionId> region_of(complex.volumes.size());
    add_filled_regions(complex, filled, region_of, a);
    if (!hollow.empty()) {
        std::vector<StatedRegion> lists;
        for (const std::uint32_t v : hollow) lists.push_back(complex.volumes[v].boundary);
        // Meshers are not strict about signs where nothing depends on them: some write none at all.
        const bool is_signed = std::ranges::any_of(lists, has_a_sign);
        if (!is_signed) find_sides_of_lists(a, lists);
        const auto ids = add_stated_regions(a, lists);
        if (is_signed) report_wrong_sides(a);
        a.claims = {};
        for (std::size_t i = 0; i < hollow.size(); ++i) region_of[hollow[i]] = ids[i];
    }
    make_lists(complex, compare_regions(stated, region_of, a), a);
}

/// Cells of meshes that bear the name of a region fill it.
void fill_hollow_regions(const SurfaceComplex& complex, Assembly& a) {
    for (const auto& filling : complex.fillings) {
        const auto& from = complex.meshes[filling.mesh];
        const auto region =
            std::ranges::find_if(a.brep.regions, [&](const auto& r) { return r.name == filling.region && r.cell_types.empty(); });
        if (region == a.brep.regions.end()) continue;
        auto filled = CellRegions(a.brep, *from.mesh, from.vertex_of).make(filling.cells).region;
        filled.name = region->name;
        filled.sides = region->sides;
        filled.source_object = from.object;
        for (const Attribute& attribute : from.mesh->info.attributes) {
            if (attribute.location == AttributeLocation::object) filled.attributes.push_back(attribute);
        }
        *region = std::move(filled);
    }
}

}  // namespace

void make_regions(const SurfaceComplex& complex, Assembly& a) {
    a.cones = cone_volumes(a.brep, a.faces);
    const auto stated = stated_regions(complex, reversed_keys(complex, a));
    const bool cells = std::ranges::any_of(complex.volumes, [](const auto& v) { return !v.cells.empty(); });
    if (cells || (!complex.volumes.empty() && stated.empty())) {
        regions_from_volumes(complex, stated, a);
    } else if (!stated.empty()) {
        make_lists(complex, add_stated_regions(a, stated), a);
        fill_hollow_regions(complex, a);
    } else {
        add_found_regions(a);
        make_lists(complex, {}, a);
    }
    settle_universe(a);
}

}  // namespace geomend::topology
