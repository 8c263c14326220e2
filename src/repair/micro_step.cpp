// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/wording.h"
#include "repair/scars.h"
#include "repair/soup_edges.h"
#include "repair/soup_measures.h"
#include "repair/surface_result.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

constexpr unsigned most_rounds = 50;

double total_volume(const Brep& brep) {
    double sum = 0;
    for (const auto& region : brep->regions) sum += region.volume_known ? std::max(region.volume, 0.0) : 0;
    return sum;
}

/// Which of two interfaces rather goes: horizons before what has no role, before faults; boundaries never (N. Euler's rules 1 to 3).
int reluctance(FeatureRole role) {
    switch (role) {
        case FeatureRole::horizon:
        case FeatureRole::unconformity:
            return 0;
        case FeatureRole::unknown:
            return 1;
        case FeatureRole::fault:
        case FeatureRole::fracture:
            return 2;
        case FeatureRole::intrusion:
            return 3;
        case FeatureRole::boundary:
        case FeatureRole::topography:
            return 4;
    }
    return 4;
}

/// A region that is merged into another one, and the surfaces between them that go.
struct Merge {
    std::uint32_t region, into;
    std::vector<std::uint32_t> surfaces;
};

class MicroRegions {
public:
    MicroRegions(const SurfaceModel& model, const PiecesOfModel& pieces, double limit) : m_(model), pieces_(pieces), limit_(limit) {
        for (const auto& triangles : pieces_.triangles) {
            double area = 0;
            for (const std::uint32_t t : triangles) area += triangle_area(m_.model.soup, t);
            areas_.push_back(area);
        }
    }

    /// The smallest regions first; of neighbours one at a time.
    std::vector<Merge> find() const {
        const auto& regions = pieces_.brep->regions;
        std::vector<std::uint32_t> small;
        for (std::uint32_t r = 0; r < regions.size(); ++r) {
            if (regions[r].volume_known && regions[r].volume < limit_) small.push_back(r);
        }
        std::ranges::sort(small, [&](std::uint32_t a, std::uint32_t b) {
            return regions[a].volume != regions[b].volume ? regions[a].volume < regions[b].volume : a < b;
        });
        std::vector<std::uint8_t> touched(regions.size(), 0);
        std::vector<Merge> merges;
        for (const std::uint32_t r : small) {
            auto merge = merge_of(r);
            if (merge.surfaces.empty() || touched[r] != 0 || touched[merge.into] != 0) continue;
            touched[r] = touched[merge.into] = 1;
            merges.push_back(std::move(merge));
        }
        return merges;
    }

private:
    FeatureRole role(std::uint32_t s) const { return pieces_.brep->surfaces[s].role; }

    /// The region on the other side of a surface of a region; no_index: none, or the region itself.
    std::uint32_t across(std::uint32_t s, std::uint32_t region) const {
        const auto& sides = pieces_.brep->surfaces[s].regions;
        if (!sides[0].valid() || !sides[1].valid() || sides[0] == sides[1]) return no_index;
        return sides[0].value == region ? sides[1].value : sides[0].value;
    }

    /// Across the interface that goes before others, and of those across the one with the largest area in common.
    Merge merge_of(std::uint32_t region) const {
        struct Way {
            int reluctance;
            double area = 0;
            std::vector<std::uint32_t> surfaces;
        };
        std::map<std::pair<std::uint32_t, std::uint32_t>, Way> ways;  // neighbour, interface
        for (const auto& side : pieces_.brep->regions[region].sides) {
            const std::uint32_t s = side.surface.value, other = across(s, region);
            if (other == no_index || reluctance(role(s)) >= 4) continue;
            Way& way =
                ways.try_emplace({other, pieces_.brep->surfaces[s].interface_id.value}, Way{reluctance(role(s)), 0, {}}).first->second;
            way.area += areas_[s];
            way.surfaces.push_back(s);
        }
        const auto best = std::ranges::min_element(ways, [](const auto& a, const auto& b) {
            if (a.second.reluctance != b.second.reluctance) return a.second.reluctance < b.second.reluctance;
            return a.second.area > b.second.area;
        });
        Merge merge{region, no_index, {}};
        if (best == ways.end()) return merge;
        merge.into = best->first.first;
        for (const auto& [key, way] : ways) {
            // What else lies between the two would lie inside of one: faults may, others go, too.
            const bool goes = key == best->first || (key.first == merge.into && way.reluctance < 2);
            if (goes) merge.surfaces.insert(merge.surfaces.end(), way.surfaces.begin(), way.surfaces.end());
        }
        return merge;
    }

    const SurfaceModel& m_;
    const PiecesOfModel& pieces_;
    double limit_;
    std::vector<double> areas_;
};

/// Takes triangles away and heals what they leave: lips of one surface along their border.
void remove_triangles(SurfaceModel& model, std::span<const std::uint8_t> gone, const ScarRules& rules, ScarCounts& counts) {
    const TriangleSoup& soup = model.model.soup;
    const SoupEdges edges = edges_of(soup);
    std::vector<std::array<std::uint32_t, 2>> lines;
    std::vector<std::uint32_t> trace;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto is_gone = [&](const auto& use) { return gone[use.triangle] != 0; };
        if (std::ranges::none_of(edges[e], is_gone) || std::ranges::all_of(edges[e], is_gone)) continue;
        lines.push_back({edges[e][0].low, edges[e][0].high});
        trace.insert(trace.end(), {edges[e][0].low, edges[e][0].high});
    }
    std::ranges::sort(trace);
    trace.erase(std::unique(trace.begin(), trace.end()), trace.end());
    TriangleSoup kept;
    Origin origin;
    kept.vertices = soup.vertices;
    for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) origin.vertices.push_back(Origin::from_vertex(v));
    std::vector<std::uint8_t> left(model.model.patches.size(), 0), was(left);
    std::vector<std::uint32_t> removed;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        was[soup.patches[t]] = 1;
        if (gone[t] != 0) removed.push_back(t);
        if (gone[t] != 0) continue;
        left[soup.patches[t]] = 1;
        kept.triangles.push_back(soup.triangles[t]);
        kept.patches.push_back(soup.patches[t]);
        origin.triangles.push_back(t);
    }
    for (std::size_t e = 0; e < soup.edges.size(); ++e) {
        const auto& [a, b] = soup.edges[e];
        if (std::ranges::binary_search(lines, std::array{std::min(a, b), std::max(a, b)})) continue;
        kept.edges.push_back(soup.edges[e]);
        kept.edge_ids.push_back(soup.edge_ids[e]);
    }
    for (auto p = static_cast<std::uint32_t>(model.became.size()); p < left.size(); ++p) model.became.push_back(p);
    for (std::uint32_t& p : model.became) {
        if (p != no_index && was[p] != 0 && left[p] == 0) p = no_index;
    }
    note_removed(model, removed, Removal::micro);
    take_soup(model, std::move(kept), origin);
    stitch_lips(model, rules, counts, &lines);
    erase_scars(model, trace, false, rules, counts);
}

}  // namespace

Result<StepOutcome> merge_micro_regions(SurfaceModel& model, const SurfaceStepOptions& options) {
    StepOutcome outcome;
    ScarCounts scars;
    const ScarRules rules = scar_rules(model, options);
    double limit = options.micro_volume;
    std::string merged;
    for (unsigned round = 0; round < most_rounds; ++round) {
        auto pieces = pieces_of(model);
        if (!pieces) return std::move(pieces).why();
        if (limit < 0) limit = 1e-6 * total_volume(pieces->brep);
        const auto merges = MicroRegions(model, *pieces, limit).find();
        if (merges.empty()) break;
        std::vector<std::uint8_t> gone(model.model.soup.triangles.size(), 0);
        for (const Merge& merge : merges) {
            for (const std::uint32_t s : merge.surfaces) {
                for (const std::uint32_t t : pieces->triangles[s]) gone[t] = 1;
            }
            if (outcome.changed < 10) {
                const auto& surface = pieces->brep->surfaces[merge.surfaces.front()];
                merged += (merged.empty() ? "" : ", ") + rounded(pieces->brep->regions[merge.region].volume) + " across " +
                          quoted(pieces->brep->interfaces[surface.interface_id.value].name);
            } else if (outcome.changed == 10) {
                merged += ", ...";
            }
            ++outcome.changed;
        }
        remove_triangles(model, gone, rules, scars);
    }
    outcome.what.message = outcome.changed == 0 ? "no region smaller than " + rounded(limit) + " can be merged into another one"
                                                : counted(outcome.changed, "region", "regions") + " smaller than " + rounded(limit) +
                                                      " merged into others (" + merged + "); " + scars_text(scars, rules.distance);
    return outcome;
}

}  // namespace geomend::repair
