// SPDX-License-Identifier: AGPL-3.0-or-later
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrangement/arrange.h"
#include "base/monitor.h"
#include "base/wording.h"
#include "repair/known_cuts.h"
#include "repair/lay_borders.h"
#include "repair/overlaps.h"
#include "repair/soup_edges.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

std::string message_of(const arrangement::Arrangement& a, const char* nothing) {
    if (a.cut + a.merged + a.collapsed + a.doubled + a.made == 0) return nothing;
    return counted(a.cut, "triangle was cut", "triangles were cut") + ", " + counted(a.made, "vertex", "vertices") + " made, " +
           counted(a.merged, "vertex", "vertices") + " merged, " + counted(a.collapsed, "triangle", "triangles") +
           " without area left out, " + counted(a.doubled, "double", "doubles") + " left out";
}

/// A second cut finds the borders of the first one no more, so that they stay.
void note_uncut_borders(SurfaceModel& model) {
    if (!model.uncut_borders.empty()) return;
    const TriangleSoup& soup = model.model.soup;
    const SoupEdges edges = edges_of(soup);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (!is_free(edges[e])) continue;
        const auto& use = edges[e][0];
        model.uncut_borders.push_back({soup.vertices[use.low], soup.vertices[use.high], soup.patches[use.triangle]});
    }
}

/// What lay in other surfaces and was left out: as a sentence, and the surfaces in it as entities.
void tell_overlaps(const SurfaceModel& model, const std::vector<LeftOverlap>& left_out, StepOutcome& outcome) {
    constexpr std::size_t most_named = 5;
    for (std::size_t i = 0; i < left_out.size(); ++i) {
        const LeftOverlap& o = left_out[i];
        outcome.changed += o.triangles;
        if (i > most_named) continue;
        if (i == most_named) {
            outcome.what.message += "; and " + std::to_string(left_out.size() - i) + " pairs more";
            continue;
        }
        const auto& patches = model.model.patches;
        outcome.what.message += "; " + (o.whole ? "all of " : counted(o.triangles, "triangle", "triangles") + " of ") +
                                quoted(patches[o.left_out].name) + " in " + quoted(patches[o.kept].name) + " left out";
        outcome.what.entities.push_back({"surface", patches[o.left_out].name});
        outcome.what.entities.push_back({"surface", patches[o.kept].name});
    }
}

Result<arrangement::Arrangement> arranged(const TriangleSoup& soup, const SurfaceModel& model, const SurfaceStepOptions& options,
                                          double reach, bool sheets) {
    // Where all within the tolerance is one, and does not settle soon, it does not settle.
    const unsigned most_rounds = sheets ? arrangement::ArrangeOptions().most_rounds : 8;
    const arrangement::ArrangeOptions of_cut{
        .tolerance = model.lengths.tolerance, .reach = reach, .most_rounds = most_rounds, .sheets = sheets, .monitor = options.monitor};
    if (options.cuts == nullptr) return arrangement::arrange(soup, of_cut);
    if (const auto known = options.cuts->find(soup, of_cut)) return arrangement::Arrangement(*known);
    auto cut = arrangement::arrange(soup, of_cut);
    const bool stopped = options.monitor != nullptr && options.monitor->stopped();
    if (cut && !stopped) options.cuts->add(soup, of_cut, *cut);
    return cut;
}

/// Puts what was cut in place of the soup. \param nothing what the report says where nothing was done
StepOutcome take_arrangement(SurfaceModel& model, arrangement::Arrangement cut, const char* nothing) {
    StepOutcome outcome;
    outcome.what.message = message_of(cut, nothing);
    if (!cut.clean) outcome.what.message += "; after " + counted(cut.rounds, "round", "rounds") + " something still crosses";
    outcome.changed = cut.cut + cut.merged + cut.collapsed + cut.doubled;
    const Displacement d = displacement(model.model.soup, cut.soup, cut.becomes);
    outcome.max_displacement = d.largest;
    outcome.mean_displacement = d.mean;
    take_soup(model, std::move(cut.soup), cut.origin);
    tell_overlaps(model, leave_out_overlaps(model), outcome);
    return outcome;
}

/// Brings borders onto what they run along, and cuts; again where that has brought others near.
Result<StepOutcome> weld_borders(SurfaceModel& model, const SurfaceStepOptions& options, const char* nothing) {
    constexpr unsigned most_rounds = 2;
    StepOutcome all;
    std::uint64_t moved = 0, made = 0, dropped = 0;
    for (unsigned round = 0; round < most_rounds; ++round) {
        LaidBorders laid = lay_borders(model.model.soup, model.lengths.tolerance);
        const std::uint64_t changed = laid.moved + laid.made + laid.dropped;
        if (round > 0 && changed == 0) break;
        if (changed == 0) {  // it would be a cut alone
            all.what.message =
                "surfaces are so near each other that what lies within the tolerance would not settle as one, and no border "
                "runs along another: nothing was done";
            return all;
        }
        auto cut = arranged(laid.soup, model, options, arrangement::ArrangeOptions().reach, true);
        if (!cut) return std::move(cut).why();
        const bool is_clean = cut->clean;
        if (round > 0 && !is_clean) break;
        const auto became = std::span(cut->becomes).first(model.model.soup.vertices.size());
        const Displacement d = displacement(model.model.soup, cut->soup, became);
        take_soup(model, std::move(laid.soup), laid.origin);
        StepOutcome outcome = take_arrangement(model, std::move(*cut), nothing);
        outcome.changed += changed;
        moved += laid.moved;
        made += laid.made;
        dropped += laid.dropped;
        if (round == 0) {
            all = std::move(outcome);
            all.max_displacement = d.largest;
            all.mean_displacement = d.mean;
            if (!is_clean) break;  // what does not settle only grows when it is cut again
            continue;
        }
        all.changed += outcome.changed;
        all.max_displacement += d.largest;  // at most
    }
    all.what.message += "; borders alone became one with what they lie on within the tolerance (" +
                        counted(moved, "vertex was", "vertices were") + " moved there, " + std::to_string(made) + " made, " +
                        counted(dropped, "sliver", "slivers") +
                        " left out): surfaces are so near each other that all of it would not settle";
    return all;
}

}  // namespace

Result<StepOutcome> weld_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    constexpr double nearly_all = 0.99;  // vertices keep the tolerance from each other, so that edges bend and do not fold
    constexpr const char* nothing = "nothing lies within the tolerance of something else, and nothing crosses";
    note_uncut_borders(model);
    auto cut = arranged(model.model.soup, model, options, nearly_all, false);
    if (!cut) return std::move(cut).why();
    if (!cut->clean) return weld_borders(model, options, nothing);
    return take_arrangement(model, std::move(*cut), nothing);
}

Result<StepOutcome> cut_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    note_uncut_borders(model);
    auto cut = arranged(model.model.soup, model, options, arrangement::ArrangeOptions().reach, true);
    if (!cut) return std::move(cut).why();
    return take_arrangement(model, std::move(*cut), "nothing crosses");
}

}  // namespace geomend::repair
