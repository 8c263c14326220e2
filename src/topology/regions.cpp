// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/regions.h"

#include <cmath>
#include <limits>

#include "base/codes.h"
#include "topology/face_volume.h"
#include "topology/frontiers.h"
#include "topology/side_solver.h"

namespace geomend::topology {

namespace {

constexpr std::size_t most_elements = 100;

std::string list_of_names(const BrepData& brep, const std::vector<SurfaceId>& surfaces) {
    std::string text;
    for (std::size_t i = 0; i < surfaces.size() && i < 5; ++i) text += (i == 0 ? "'" : ", '") + brep.surfaces[surfaces[i].value].name + "'";
    if (surfaces.size() > 5) text += ", ...";
    return text;
}

void mention(Finding& finding, const BrepData& brep, const std::vector<SurfaceId>& surfaces) {
    finding.count = surfaces.size();
    for (std::size_t i = 0; i < surfaces.size() && i < most_elements; ++i) {
        finding.entities.push_back({"surface", brep.surfaces[surfaces[i].value].name, surfaces[i].value});
        finding.index.push_back(surfaces[i].value);
    }
    finding.element_kind = "surface";
}

/// Gives a finding lines of the model as its place.
void place_on_lines(Finding& finding, const BrepData& brep, const std::vector<LineId>& lines) {
    for (const LineId l : lines) {
        if (finding.polylines.size() == most_elements) return;
        std::vector<Vec3>& polyline = finding.polylines.emplace_back();
        for (const VertexId v : brep.lines[l.value].vertices) polyline.push_back(brep.vertices[v.value]);
    }
    if (!finding.polylines.empty()) finding.points.push_back(finding.polylines.front().front());
}

void judge_stated(Assembly& a, const StatedRegion& stated, const SolvedSides::Region& solved) {
    if (stated.sides.empty()) {
        a.findings.push_back(region_finding(a.brep, "F121", stated.name, "region '" + stated.name + "' has no boundary"));
        return;
    }
    // A region may have nothing but internal surfaces: then there is nothing to close.
    if (!solved.enclosed.closed && solved.enclosed.singles > 0) {
        auto finding = region_finding(a.brep, "F113", stated.name,
                                      "the boundary of region '" + stated.name + "' does not close, so that its volume is not known");
        finding.measures = {{"open_sides", static_cast<double>(solved.enclosed.singles)}};
        place_on_lines(finding, a.brep, solved.enclosed.open_lines);
        a.findings.push_back(std::move(finding));
    }
}

}  // namespace

Finding region_finding(const BrepData&, std::string code, std::string region, std::string message) {
    Finding finding = make_finding(code, std::move(message), {}, 0);
    finding.entities.push_back({"region", std::move(region), -1});
    return finding;
}

std::vector<RegionId> add_stated_regions(Assembly& a, const std::vector<StatedRegion>& stated) {
    std::vector<std::vector<BrepData::Side>> sides;
    std::uint32_t universe = no_index;
    for (std::uint32_t r = 0; r < stated.size(); ++r) {
        sides.push_back(stated[r].sides);
        if (stated[r].universe) universe = r;
    }
    const SolvedSides solved = solve_sides(sides, universe, a.cones, a.graph);
    a.claims.reversed_convention = solved.reversed_convention;
    std::vector<RegionId> ids;
    for (std::uint32_t r = 0; r < stated.size(); ++r) {
        auto as_stated = enclosed(stated[r].sides, a.cones, a.graph);
        if (solved.reversed_convention) as_stated.volume = -as_stated.volume;
        judge_stated(a, stated[r], solved.regions[r]);
        if (!solved.regions[r].turned.empty()) {
            const std::int64_t number = r == universe ? -1 : static_cast<std::int64_t>(a.brep.regions.size());
            a.claims.wrong_sides.push_back(
                {stated[r].name, number, solved.regions[r].turned, as_stated.volume, solved.regions[r].enclosed.volume});
        }
        if (r == universe) {
            a.brep.universe = solved.regions[r].sides;
            a.claims.universe_stated = true;
            a.claims.universe_name = stated[r].name;
            a.claims.universe = solved.regions[r].sides;
            ids.emplace_back();
            continue;
        }
        ids.emplace_back(a.brep.regions.size());
        BrepData::Region region;
        region.name = stated[r].name;
        region.sides = solved.regions[r].sides;
        region.volume_known = solved.regions[r].enclosed.closed;
        region.volume = region.volume_known ? solved.regions[r].enclosed.volume : std::numeric_limits<double>::quiet_NaN();
        a.brep.regions.push_back(std::move(region));
    }
    return ids;
}

void report_wrong_sides(Assembly& a) {
    for (const auto& wrong : a.claims.wrong_sides) {
        auto finding = region_finding(a.brep, "F113", wrong.name,
                                      "region '" + wrong.name + "' is stated on the wrong side of " + list_of_names(a.brep, wrong.turned) +
                                          "; its boundary was turned to what the geometry shows");
        mention(finding, a.brep, wrong.turned);
        finding.measures = {{"volume_as_stated", wrong.volume_as_stated}, {"volume", wrong.volume}};
        a.findings.push_back(std::move(finding));
    }
}

void add_found_regions(Assembly& a) {
    a.found = find_regions(a.brep, a.graph, a.cones, a.tolerances);
    const FoundRegions& found = a.found;
    for (const auto& sides : found.regions) {
        BrepData::Region region;
        region.name = "Region_" + std::to_string(a.brep.regions.size() + 1);
        const Enclosed e = enclosed(sides, a.cones, a.graph);
        region.sides = sides;
        region.volume_known = e.closed;
        region.volume = e.closed ? e.volume : std::numeric_limits<double>::quiet_NaN();
        a.brep.regions.push_back(std::move(region));
    }
    if (!found.regions.empty()) a.brep.universe = found.universe;  // surfaces that enclose nothing state no outside, either
    if (found.uncertain_lines.empty()) return;
    Finding finding =
        make_finding("F113", "polygons coincide along lines, so that regions there are not certain", {}, found.uncertain_lines.size());
    finding.element_kind = "line";
    finding.measures = {{"uncertain_lines", static_cast<double>(found.uncertain_lines.size())}};
    for (const LineId l : found.uncertain_lines) {
        if (finding.index.size() < most_elements) finding.index.push_back(l.value);
    }
    a.findings.push_back(std::move(finding));
}

void settle_universe(Assembly& a) {
    std::vector<SurfaceId> contested;
    for (std::uint32_t r = 0; r < a.brep.regions.size(); ++r) {
        for (const auto& side : a.brep.regions[r].sides) {
            RegionId& region = a.brep.surfaces[side.surface.value].regions[side.front ? 1 : 0];
            if (region.valid() && region != RegionId(r) && (contested.empty() || contested.back() != side.surface)) {
                contested.push_back(side.surface);
            }
            if (!region.valid()) region = RegionId(r);
        }
    }
    if (!contested.empty()) {
        Finding finding = make_finding("F113", "several regions lie on the same side of " + list_of_names(a.brep, contested), {}, 0);
        mention(finding, a.brep, contested);
        finding.measures = {{"shared_sides", static_cast<double>(contested.size())}};
        a.findings.push_back(std::move(finding));
    }
    if (a.brep.universe.empty() && !a.brep.regions.empty()) {
        for (std::uint32_t s = 0; s < a.brep.surfaces.size(); ++s) {
            for (const bool front : {false, true}) {
                if (!a.brep.surfaces[s].regions[front ? 1 : 0].valid()) a.brep.universe.push_back({SurfaceId(s), front});
            }
        }
    }
    const Enclosed outside = enclosed(a.brep.universe, a.cones, a.graph);
    if (outside.closed) {
        a.brep.universe_volume = std::abs(outside.volume);
        return;
    }
    PreciseSum sum;
    bool all_known = !a.brep.regions.empty();
    for (const auto& region : a.brep.regions) {
        all_known &= region.volume_known;
        sum.add(region.volume);
    }
    a.brep.universe_volume = all_known ? sum.value() : 0;
}

}  // namespace geomend::topology
