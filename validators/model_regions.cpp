// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "geometry/cell_volume.h"
#include "validators/cell_findings.h"
#include "validators/each_surface.h"
#include "validators/free_borders.h"
#include "validators/model_checks.h"
#include "validators/places.h"
#include "validators/region_volumes.h"
#include "validators/stated_records.h"

namespace geomend::validators {

namespace {

std::uint32_t side_index(const BrepData::Side& side) { return 2 * side.surface.value + (side.front ? 1 : 0); }

/// The sides of a region whose opposites are not its own, too; they ascend.
std::vector<std::uint32_t> single_sides(std::span<const BrepData::Side> sides) {
    std::vector<std::uint32_t> all;
    for (const auto& side : sides) all.push_back(side_index(side));
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::vector<std::uint32_t> single;
    for (const std::uint32_t side : all) {
        if (!std::ranges::binary_search(all, side ^ 1u)) single.push_back(side);
    }
    return single;
}

bool has_free_border(const ModelScope& scope, const BrepData::Surface& surface) {
    return std::ranges::any_of(surface.lines, [&](const auto& use) { return scope.free_lines()[use.line.value] != 0; });
}

using StatedSides = std::vector<std::array<std::uint32_t, 2>>;

/// The regions that the file's own lists put on the two sides of each surface; none: no_index, the Universe: its own number.
StatedSides stated_sides(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    StatedSides stated(brep.surfaces.size(), {no_index, no_index});
    if (!scope.model().regions_stated) return stated;
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        for (const auto& side : brep.regions[r].sides) stated[side.surface.value][side.front ? 1 : 0] = r;
    }
    const auto outside = static_cast<std::uint32_t>(brep.regions.size());
    for (const auto& side : brep.universe) {
        auto& slot = stated[side.surface.value][side.front ? 1 : 0];
        if (slot == no_index) slot = outside;
    }
    return stated;
}

}  // namespace

namespace {

/// What the list of a region would have to change to bound the region that its surfaces enclose.
struct ListDifference {
    std::vector<std::uint32_t> missing, foreign;  ///< sides: 2 x surface, + 1 for the front

    /// "lacks -4 (TFACE 4 of 'H1') and has +7 (...) too many"
    std::string text(const StatedRecords& records) const {
        std::string words;
        if (!missing.empty()) words += "lacks " + records.sides_text(missing);
        if (!foreign.empty()) words += std::string(words.empty() ? "" : ", and ") + "should not have " + records.sides_text(foreign);
        return words;
    }
    /// Which advice is given depends on them.
    std::vector<std::pair<std::string, double>> measures() const {
        return {{"sides_missing", static_cast<double>(missing.size())}, {"sides_too_many", static_cast<double>(foreign.size())}};
    }
    void name_surfaces(const ModelScope& scope, Finding& finding) const {
        std::set<std::uint32_t> named;
        for (const auto* list : {&missing, &foreign}) {
            for (const std::uint32_t side : *list) {
                if (named.insert(side / 2).second && finding.entities.size() < listed_elements)
                    finding.entities.push_back(surface_ref(scope, side / 2));
            }
        }
    }
};

/// \param stated, found single sides, ascending
ListDifference difference(const std::vector<std::uint32_t>& stated, const std::vector<std::uint32_t>& found) {
    ListDifference d;
    std::ranges::set_difference(found, stated, std::back_inserter(d.missing));
    std::ranges::set_difference(stated, found, std::back_inserter(d.foreign));
    return d;
}

/// Surfaces that two lists have on their sides, as they should, but that end freely, so that the two regions run into one another.
std::vector<std::uint32_t> ending_short(const ModelScope& scope, const std::vector<std::uint32_t>& sides, const StatedSides& stated) {
    const auto& region_of = scope.model().found.region_of_side;
    std::vector<std::uint32_t> surfaces;
    for (const std::uint32_t side : sides) {
        const std::uint32_t s = side / 2;
        if (stated[s][0] != stated[s][1] && stated[s][0] != no_index && stated[s][1] != no_index &&
            region_of[side] == region_of[side ^ 1u] && has_free_border(scope, scope.brep().surfaces[s]))
            surfaces.push_back(s);
    }
    return surfaces;
}

/// Where most of the stated sides bound one region that is found by walking along surfaces, the list is what is wrong; unless a
/// surface in it ends short.
void add_list_difference(const ModelScope& scope, const StatedRecords& records, std::uint32_t region,
                         const std::vector<std::uint32_t>& single, const StatedSides& stated, Finding& finding) {
    const auto& found = scope.model().found;
    if (found.region_of_side.empty()) return;
    std::map<std::uint32_t, std::size_t> times;
    for (const std::uint32_t side : single) {
        if (found.region_of_side[side] != no_index) ++times[found.region_of_side[side]];
    }
    if (times.empty()) return;
    const auto most = std::ranges::max_element(times, {}, [](const auto& entry) { return entry.second; });
    const auto sides = single_sides(found.regions[most->first]);
    if (const auto short_ones = ending_short(scope, single, stated); !short_ones.empty()) {
        finding.message += "; " + quoted(scope.brep().surfaces[short_ones[0]].name);
        if (short_ones.size() > 1) finding.message += " and " + counted(short_ones.size() - 1, "other surface", "other surfaces");
        finding.message += std::string(short_ones.size() > 1 ? " end" : " ends") + " before the boundary closes";
        for (const std::uint32_t s : short_ones) {
            if (finding.entities.size() < listed_elements) finding.entities.push_back(surface_ref(scope, s));
        }
        return;
    }
    if (2 * most->second <= std::max(sides.size(), single.size())) return;
    const ListDifference d = difference(single, sides);
    if (d.missing.empty() && d.foreign.empty()) return;
    finding.measures = d.measures();
    finding.message += "; the list of region " + quoted(scope.brep().regions[region].name) + " " + d.text(records);
    d.name_surfaces(scope, finding);
}

}  // namespace

void check_region_closed(const ModelScope& scope, std::vector<Finding>& findings) {
    if (!scope.model().regions_stated) return;
    const BrepData& brep = scope.brep();
    const StatedRecords records(scope);
    const auto stated = stated_sides(scope);
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        const auto& region = brep.regions[r];
        if (!region.cell_types.empty() || region.volume_known) continue;
        const auto single = single_sides(region.sides);
        if (single.empty() && !region.sides.empty()) continue;
        Finding finding = finding_of("B05", region.sides.empty() ? "region " + quoted(region.name) + " has no boundary"
                                                                 : "the boundary of region " + quoted(region.name) + " does not close");
        finding.entities.push_back(region_ref(scope, r));
        std::map<std::uint32_t, std::int64_t> net;
        for (const std::uint32_t side : single) {
            for (const auto& [line, sum] : scope.model().graph.nets[side / 2]) net[line] += side % 2 == 1 ? -sum : sum;
        }
        for (const auto& [line, sum] : net) {
            if (sum == 0) continue;
            ++finding.count;
            if (finding.index.size() < listed_elements) finding.index.push_back(line);
            mark_line(scope, line, finding);
        }
        finding.element_kind = "line";
        if (finding.count > 0) finding.message += ": it is open along " + counted(finding.count, "line", "lines");
        if (region.sides.empty()) finding.measures = {{"sides", 0}};
        else add_list_difference(scope, records, r, single, stated, finding);
        findings.push_back(std::move(finding));
    }
}

void check_model_closed(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    if (!scope.model().regions_stated || !scope.model().found.regions.empty() || brep.surfaces.empty()) return;
    if (std::ranges::any_of(brep.regions, [](const auto& region) { return !region.cell_types.empty(); })) return;
    const auto open = static_cast<std::uint64_t>(std::ranges::count(scope.free_lines(), 1));
    const bool one = brep.surfaces.size() == 1;
    Finding finding = finding_of("B06", (one ? std::string("the surface") : "the " + std::to_string(brep.surfaces.size()) + " surfaces") +
                                            " of model " + quoted(brep.name) + (one ? " encloses" : " enclose") + " no volume; " +
                                            counted(open, "line is a free border", "lines are free borders"));
    finding.entities.push_back({"model", brep.name});
    finding.count = open;
    finding.element_kind = "line";
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        if (scope.free_lines()[l] == 0) continue;
        if (finding.index.size() < listed_elements) finding.index.push_back(l);
        mark_line(scope, l, finding);
    }
    for (std::uint32_t s = 0; s < brep.surfaces.size() && finding.entities.size() < listed_elements; ++s) {
        if (has_free_border(scope, brep.surfaces[s])) finding.entities.push_back(surface_ref(scope, s));
    }
    findings.push_back(std::move(finding));
}

void check_free_ends(const ModelScope& scope, std::vector<Finding>& findings) {
    const auto& found = scope.model().found;
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        const bool must_not =
            is_stratigraphic(surface.role) || surface.role == FeatureRole::topography || surface.role == FeatureRole::intrusion;
        if (!must_not || !has_free_border(scope, surface)) return std::nullopt;
        const std::uint32_t region = found.region_of_side[2 * s];
        if (region == no_index || region != found.region_of_side[2 * s + 1]) return std::nullopt;
        Finding finding = finding_of("B09", quoted(surface.name) + " ends inside " + found_region_name(scope, region) +
                                                ", which only faults and fractures may: it is stated as " + to_string(surface.role));
        finding.entities.push_back(surface_ref(scope, s));
        finding.element_kind = "line";
        for (const auto& use : surface.lines) {
            if (scope.free_lines()[use.line.value] == 0) continue;
            ++finding.count;
            finding.index.push_back(use.line.value);
            mark_line(scope, use.line.value, finding);
        }
        return finding;
    });
}

namespace {

/// Whether two regions are volumes of one group: filled by cells, under one name. It is no defect where no surface parts them.
bool are_of_one_group(const BrepData& brep, std::uint32_t a, std::uint32_t b) {
    if (std::max(a, b) >= brep.regions.size()) return false;  // the outside
    const auto &first = brep.regions[a], &second = brep.regions[b];
    return !first.name.empty() && first.name == second.name && !first.cell_types.empty() && !second.cell_types.empty();
}

/// Lines with nothing beyond them, around which a region goes from one side of a surface to the other: the borders of holes.
/// Where faults end there is no hole, unless nothing else is there.
std::vector<std::uint32_t> hole_lines(const ModelScope& scope, std::uint32_t region) {
    const auto& found = scope.model().found;
    std::vector<std::uint32_t> holes, tips;
    for (const auto& join : found.joins) {
        if ((join.first ^ 1u) != join.second || found.region_of_side[join.first] != region) continue;
        (may_end_freely(scope.brep().surfaces[join.first / 2].role) ? tips : holes).push_back(join.line);
    }
    return holes.empty() ? tips : holes;
}

/// Of surfaces that no list names: the volume that they enclose with others, which are not cut where they meet.
std::optional<CutVolume> unlisted_volume(const ModelScope& scope, const std::vector<std::uint32_t>& surfaces, const StatedSides& stated) {
    if (!scope.model().regions_stated) return std::nullopt;
    const auto is_listed = [&](std::uint32_t s) { return stated[s][0] != no_index || stated[s][1] != no_index; };
    if (std::ranges::any_of(surfaces, is_listed)) return std::nullopt;
    for (auto& volume : volumes_when_cut(scope, surfaces)) {
        if (volume) return std::move(volume);
    }
    return std::nullopt;
}

/// "'bubble' encloses a volume of 12 with 'H2' that is in no list of a region"
std::string enclosing_text(const ModelScope& scope, const std::vector<std::uint32_t>& surfaces, const CutVolume& volume) {
    constexpr std::size_t named = 3;
    const auto name = [&](std::uint32_t s) { return quoted(scope.brep().surfaces[s].name); };
    std::string others;
    std::size_t number = 0;
    for (const std::uint32_t s : volume.surfaces) {
        if (std::ranges::find(surfaces, s) != surfaces.end()) continue;
        if (number++ < named) others += (others.empty() ? " with " : ", ") + name(s);
    }
    if (number > named) others += ", ...";
    std::string text = name(surfaces[0]);
    if (surfaces.size() > 1) text += " and " + counted(surfaces.size() - 1, "other surface", "other surfaces");
    return text + (surfaces.size() > 1 ? " enclose" : " encloses") + " a volume of " + rounded(volume.volume) + others +
           " that no region has";
}

Finding leak_finding(const ModelScope& scope, std::uint32_t region, const std::vector<std::uint32_t>& surfaces, const StatedSides& stated) {
    const BrepData& brep = scope.brep();
    Finding finding =
        finding_of("B12", found_region_name(scope, region) + " leaks: it lies on both sides of " + quoted(brep.surfaces[surfaces[0]].name));
    if (surfaces.size() > 1) finding.message += " and of " + counted(surfaces.size() - 1, "other surface", "other surfaces");
    std::set<std::string> owners;
    const auto lines = hole_lines(scope, region);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const auto& use : brep.surfaces[s].lines) {
            if (std::ranges::find(lines, use.line.value) != lines.end()) owners.insert(quoted(brep.surfaces[s].name));
        }
    }
    if (!owners.empty()) {
        finding.message += "; its sides meet around the free border of " + *owners.begin();
        if (owners.size() > 1) finding.message += ", " + *std::next(owners.begin()) + (owners.size() > 2 ? ", ..." : "");
        const auto borders = free_borders(scope, lines);
        finding.message += ": " + border_text(scope, borders);
        mark_borders(scope, borders, finding);
    } else if (const auto volume = unlisted_volume(scope, surfaces, stated)) {
        finding.measures = {{"unlisted_volume", volume->volume}};
        finding.message = enclosing_text(scope, surfaces, *volume);
    } else if (scope.model().regions_stated) {
        finding.measures = {{"stated_surfaces", static_cast<double>(surfaces.size())}};
    }
    name_surfaces(scope, surfaces, finding);
    return finding;
}

}  // namespace

void check_leaks(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const auto& found = scope.model().found;
    if (found.region_of_side.empty()) return;
    const auto stated = stated_sides(scope);
    std::map<std::uint32_t, std::vector<std::uint32_t>> leaking;  // per region
    // Cells part their regions where surfaces do not.
    const bool has_cells = std::ranges::any_of(brep.regions, [](const auto& region) { return !region.cell_types.empty(); });
    const auto bare = has_cells ? regions_with_bare_facets(scope) : std::vector<std::uint8_t>(brep.regions.size(), 0);
    const auto is_bare = [&](std::uint32_t region) { return region < bare.size() && bare[region] != 0; };
    std::vector<std::uint32_t> internal;
    const auto closing = closing_groups(scope);
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        const std::uint32_t region = found.region_of_side[2 * s];
        if (surface.polygons.size() == 0 || region != found.region_of_side[2 * s + 1]) continue;
        if (is_bare(stated[s][0]) || is_bare(stated[s][1])) continue;
        const bool lists_differ = stated[s][0] != stated[s][1] && stated[s][0] != no_index && stated[s][1] != no_index &&
                                  !are_of_one_group(brep, stated[s][0], stated[s][1]);
        const bool separates =
            is_stratigraphic(surface.role) || surface.role == FeatureRole::boundary || surface.role == FeatureRole::topography;
        const bool closed_is_meant = region != no_index || scope.model().regions_stated || closing[s] != 0;
        if (lists_differ || (separates && closed_is_meant)) leaking[region].push_back(s);
        else if (region != no_index && (scope.model().regions_stated || !is_undecided(surface.role)))
            internal.push_back(s);  // outside of all regions: B16; no role says what it is: B29
    }
    for (const auto& [region, surfaces] : leaking) findings.push_back(leak_finding(scope, region, surfaces, stated));
    for (const std::uint32_t s : internal) {
        const std::uint32_t region = found.region_of_side[2 * s];
        Finding finding =
            finding_of("B25", quoted(brep.surfaces[s].name) + " lies inside " + found_region_name(scope, region) + " with both sides");
        finding.entities.push_back(surface_ref(scope, s));
        finding.count = 1;
        for (const auto& use : brep.surfaces[s].lines) {
            if (scope.free_lines()[use.line.value] != 0) mark_line(scope, use.line.value, finding);
        }
        findings.push_back(std::move(finding));
    }
}

namespace {

/// Surfaces of which a region has both sides; they ascend.
std::vector<std::uint32_t> inner_surfaces(std::span<const BrepData::Side> sides) {
    std::set<std::uint32_t> all, inner;
    for (const auto& side : sides) all.insert(side_index(side));
    for (const std::uint32_t side : all) {
        if (all.contains(side ^ 1u)) inner.insert(side / 2);
    }
    return {inner.begin(), inner.end()};
}

/// The stated sides that bound other regions than most of them do.
std::vector<std::uint32_t> sides_of_lesser_regions(const ModelScope& scope, const std::vector<std::uint32_t>& single) {
    const auto& region_of = scope.model().found.region_of_side;
    std::map<std::uint32_t, std::size_t> times;
    for (const std::uint32_t side : single) ++times[region_of[side]];
    const auto most = std::ranges::max_element(times, {}, [](const auto& entry) { return entry.second; });
    std::vector<std::uint32_t> lesser;
    std::ranges::copy_if(single, std::back_inserter(lesser), [&](std::uint32_t side) { return region_of[side] != most->first; });
    return lesser;
}

}  // namespace

void check_stated_regions(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const StatedRecords records(scope);
    const auto& found = scope.model().found;
    if (!scope.model().regions_stated || found.region_of_side.empty()) return;
    const auto stated = stated_sides(scope);
    std::vector<std::vector<std::uint32_t>> found_single;
    for (const auto& sides : found.regions) found_single.push_back(single_sides(sides));
    const bool has_cells = std::ranges::any_of(brep.regions, [](const auto& region) { return !region.cell_types.empty(); });
    const auto bare = has_cells ? regions_with_bare_facets(scope) : std::vector<std::uint8_t>(brep.regions.size(), 0);
    const auto volumes = volumes_of_regions(scope);
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        const auto& region = brep.regions[r];
        const auto single = single_sides(region.sides);
        if (single.empty() || bare[r] != 0 || (!region.volume_known && region.cell_types.empty())) continue;
        if (region.cell_types.empty() && volumes[r].count > 1) {
            Finding finding = finding_of("B13", "region " + quoted(region.name) + " is stated as one, but surfaces inside divide it into " +
                                                    std::to_string(volumes[r].count) + " volumes");
            finding.entities.push_back(region_ref(scope, r));
            finding.count = volumes[r].count;
            finding.element_kind = "volume";
            finding.measures = {{"volumes", static_cast<double>(volumes[r].count)}};
            std::vector<std::uint32_t> inside = inner_surfaces(region.sides);
            inside.insert(inside.end(), volumes[r].unlisted.begin(), volumes[r].unlisted.end());
            for (const std::uint32_t s : inside) {
                if (finding.entities.size() < listed_elements) finding.entities.push_back(surface_ref(scope, s));
            }
            findings.push_back(std::move(finding));
            continue;
        }
        std::set<std::uint32_t> touched;
        for (const std::uint32_t side : single) touched.insert(found.region_of_side[side]);
        if (touched.size() == 1 && *touched.begin() != no_index && found_single[*touched.begin()] == single) continue;
        const bool one = touched.size() == 1 && *touched.begin() != no_index;
        ListDifference d;
        if (one) d = difference(single, found_single[*touched.begin()]);
        const auto is_its_own = [&](std::uint32_t side) { return are_of_one_group(brep, r, stated[side / 2][side % 2]); };
        const bool runs_into_its_own = one && std::ranges::all_of(d.missing, is_its_own) &&
                                       std::ranges::all_of(d.foreign, [&](std::uint32_t side) { return is_its_own(side ^ 1u); });
        std::string message =
            "region " + quoted(region.name) + " is stated with " + counted(single.size(), "side", "sides") + " of surfaces, but ";
        if (runs_into_its_own) message += "no surface separates it from other volumes of its group";
        else if (one)
            message +=
                "the region that they bound has " + std::to_string(found_single[*touched.begin()].size()) + "; its list " + d.text(records);
        else message += "these do not bound one region: they belong to " + std::to_string(touched.size());
        Finding finding = finding_of("B13", std::move(message));
        if (runs_into_its_own) finding.measures = {{"sides_open_to_group", static_cast<double>(d.missing.size() + d.foreign.size())}};
        else if (one) finding.measures = d.measures();
        else finding.measures = {{"regions", static_cast<double>(touched.size())}};
        if (runs_into_its_own) use_other_severity(finding);
        finding.entities.push_back(region_ref(scope, r));
        if (!one) d.foreign = sides_of_lesser_regions(scope, single);
        d.name_surfaces(scope, finding);
        finding.count = one ? std::max<std::uint64_t>(1, d.missing.size() + d.foreign.size()) : 1;
        finding.element_kind = "side";
        findings.push_back(std::move(finding));
    }
}

namespace {

/// Says where two regions have the same sides: of regions of cells the faces of those cells that are fewer there; else which lists have it.
void mark_shared_sides(const ModelScope& scope, const std::pair<std::uint32_t, std::uint32_t>& regions,
                       const std::vector<std::uint32_t>& sides, Finding& finding) {
    const BrepData& brep = scope.brep();
    const auto has_cells = [&](std::uint32_t r) { return !brep.regions[r].cell_types.empty(); };
    if (!has_cells(regions.first) || !has_cells(regions.second)) {
        if (scope.model().regions_stated) finding.message += ": the lists of both have " + StatedRecords(scope).sides_text(sides);
        return;
    }
    auto first = cell_faces_on(scope, regions.first, sides), second = cell_faces_on(scope, regions.second, sides);
    if (first.empty() || second.empty()) return;
    const auto side_text = [&](std::uint32_t r, std::size_t faces) {
        return counted(faces, "face", "faces") + " of cells of " + quoted(brep.regions[r].name);
    };
    finding.message += ", where it has " + side_text(regions.first, first.size()) + " and " + side_text(regions.second, second.size());
    finding.measures = {{"faces_of_first", static_cast<double>(first.size())}, {"faces_of_second", static_cast<double>(second.size())}};
    finding.points = std::move(first.size() <= second.size() ? first : second);
    std::ranges::sort(finding.points);
    if (finding.points.size() > listed_elements) finding.points.resize(listed_elements);
}

}  // namespace

void check_region_overlap(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint32_t> owner(2 * brep.surfaces.size(), no_index);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> shared;
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        for (const auto& side : brep.regions[r].sides) {
            std::uint32_t& first = owner[side_index(side)];
            if (first == no_index) first = r;
            else if (first != r) shared[{first, r}].push_back(side_index(side));
        }
    }
    for (const auto& [pair, sides] : shared) {
        Finding finding =
            finding_of("B14", "regions " + quoted(brep.regions[pair.first].name) + " and " + quoted(brep.regions[pair.second].name) +
                                  " overlap: the file puts both on the same side of " + quoted(brep.surfaces[sides[0] / 2].name));
        finding.entities = {region_ref(scope, pair.first), region_ref(scope, pair.second)};
        for (const std::uint32_t side : sides) {
            if (finding.entities.size() < listed_elements) finding.entities.push_back(surface_ref(scope, side / 2));
        }
        finding.count = sides.size();
        finding.element_kind = "surface";
        mark_shared_sides(scope, pair, sides, finding);
        findings.push_back(std::move(finding));
    }
}

void check_thin_regions(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::vector<double> area(brep.surfaces.size());
    parallel_for_each_index(area.size(), [&](std::size_t s) {
        for (std::uint32_t t = scope.first_triangle(static_cast<std::uint32_t>(s));
             t < scope.first_triangle(static_cast<std::uint32_t>(s) + 1); ++t) {
            const auto& [a, b, c] = scope.triangles()[t];
            const Vec3 n = cross(minus(brep.vertices[b], brep.vertices[a]), minus(brep.vertices[c], brep.vertices[a]));
            area[s] += 0.5 * std::sqrt(dot(n, n));
        }
    });
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        const auto& region = brep.regions[r];
        if (!region.volume_known) continue;
        double around = 0;
        double near = 0;
        for (const auto& side : region.sides) {
            around += area[side.surface.value];
            near = std::max(near, scope.lengths(side.surface.value).near);
        }
        const double thickness = around > 0 ? 2 * region.volume / around : 0;
        if (around == 0 || thickness >= near) continue;
        Finding finding =
            finding_of("B15", "region " + quoted(region.name) + " is " + rounded(thickness) + " thick on average (twice its volume " +
                                  rounded(region.volume) + " over the area around it), less than " + rounded(near));
        finding.entities.push_back(region_ref(scope, r));
        finding.count = 1;
        finding.measures = {{"thickness", thickness}, {"volume", region.volume}};
        findings.push_back(std::move(finding));
    }
}

void check_outside_surfaces(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    const auto& found = scope.model().found;
    if (found.regions.empty() || found.region_of_side.empty()) return;
    std::vector<std::uint8_t> is_beside_cells(brep.surfaces.size(), 0);
    for (const auto& region : brep.regions) {
        if (region.cell_types.empty()) continue;
        for (const auto& side : region.sides) is_beside_cells[side.surface.value] = 1;
    }
    // Where polygons coincide at a line of a surface, which regions it bounds is not certain (B17).
    std::vector<std::uint8_t> uncertain_line(brep.lines.size(), 0);
    for (const LineId l : found.uncertain_lines) uncertain_line[l.value] = 1;
    const auto is_uncertain = [&](std::uint32_t s) {
        return std::ranges::any_of(brep.surfaces[s].lines, [&](const auto& at) { return uncertain_line[at.line.value] != 0; });
    };
    Finding finding;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        if (brep.surfaces[s].polygons.size() == 0 || is_beside_cells[s] != 0 || is_uncertain(s)) continue;
        if (found.region_of_side[2 * s] != no_index || found.region_of_side[2 * s + 1] != no_index) continue;
        if (finding.code.empty()) finding = finding_of("B16", {});
        ++finding.count;
        if (finding.entities.size() >= listed_elements) continue;
        finding.entities.push_back(surface_ref(scope, s));
        finding.index.push_back(s);
    }
    if (finding.count == 0) return;
    finding.element_kind = "surface";
    finding.message = counted(finding.count, "surface lies", "surfaces lie") + " outside all regions: " + quoted(finding.entities[0].name) +
                      (finding.count > 1 ? ", ..." : "");
    findings.push_back(std::move(finding));
}

void check_stated_borders(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::map<std::uint32_t, std::vector<std::uint32_t>> surfaces_of;  // per object
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) surfaces_of[brep.surfaces[s].source_object].push_back(s);
    for (const auto& [object, surfaces] : surfaces_of) {
        const auto* source = object < scope.dataset().objects.size() ? std::get_if<Surface>(&scope.dataset().objects[object]) : nullptr;
        if (source == nullptr || source->border_starts.empty()) continue;
        std::set<std::pair<std::uint32_t, std::uint32_t>> wanted;
        std::vector<std::uint8_t> is_end(source->points.size(), 0);  // few points are: most edges need no look into the set
        for (const auto& start : source->border_starts) {
            wanted.insert(std::minmax(start.corner, start.next));
            is_end[start.corner] = is_end[start.next] = 1;
        }
        for (std::size_t p = 0; p < source->polygons.size() && !wanted.empty(); ++p) {
            const auto polygon = source->polygons[p];
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const std::uint32_t from = polygon[i], to = polygon[i + 1 < polygon.size() ? i + 1 : 0];
                if ((is_end[from] & is_end[to]) != 0) wanted.erase(std::minmax(from, to));
            }
        }
        if (wanted.empty()) continue;
        Finding finding = finding_of("B19", {});
        for (const std::uint32_t s : surfaces) {
            if (finding.entities.size() < listed_elements && surfaces.size() == 1) finding.entities.push_back(surface_ref(scope, s));
        }
        if (finding.entities.empty()) finding.entities.push_back({"interface", source->info.name});
        for (const auto& start : source->border_starts) {
            if (!wanted.contains(std::minmax(start.corner, start.next))) continue;
            if (finding.count++ == 0)
                finding.message = ": the first one runs from point " + std::to_string(source->labels[start.corner]) + " to point " +
                                  std::to_string(source->labels[start.next]);
            if (finding.elements.size() >= listed_elements) continue;
            finding.elements.push_back(start.id);
            finding.index.push_back(&start - source->border_starts.data());
            finding.polylines.push_back({source->points[start.corner], source->points[start.next]});
        }
        finding.element_kind = "border";
        finding.message = counted(finding.count, "stated border", "stated borders") + " of " + quoted(source->info.name) +
                          (finding.count == 1 ? " starts" : " start") + " along no edge of its triangles" + finding.message;
        findings.push_back(std::move(finding));
    }
}

void spread_errors(const ModelScope& scope, std::vector<Finding>& findings) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint8_t> wrong(brep.surfaces.size(), 0);
    for (const Finding& f : findings) {
        if (f.severity != Severity::error || std::ranges::find(own_errors, f.code) == own_errors.end()) continue;
        for (const EntityRef& e : f.entities) {
            if (e.kind == "surface" && e.id >= 0 && static_cast<std::size_t>(e.id) < wrong.size())
                wrong[static_cast<std::size_t>(e.id)] = 1;
        }
    }
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        std::set<std::uint32_t> surfaces;
        for (const auto& side : brep.regions[r].sides) {
            if (wrong[side.surface.value] != 0) surfaces.insert(side.surface.value);
        }
        if (surfaces.empty()) continue;
        Finding finding = finding_of(
            "B18", "region " + quoted(brep.regions[r].name) + " is not valid because " + quoted(brep.surfaces[*surfaces.begin()].name) +
                       " is not" +
                       (surfaces.size() > 1 ? ", nor are " + std::to_string(surfaces.size() - 1) + " more of its surfaces" : ""));
        finding.entities.push_back(region_ref(scope, r));
        for (const std::uint32_t s : surfaces) {
            if (finding.entities.size() < listed_elements) finding.entities.push_back(surface_ref(scope, s));
        }
        finding.count = surfaces.size();
        finding.element_kind = "surface";
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
