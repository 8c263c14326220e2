// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string>
#include <utility>
#include <vector>

#include "arrangement/arrange.h"
#include "base/wording.h"
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

/// \param reach share of the tolerance within which a vertex becomes a part of an edge or a face
/// \param nothing what the report says where nothing was done
Result<StepOutcome> arrange_model(SurfaceModel& model, const SurfaceStepOptions& options, double reach, const char* nothing) {
    note_uncut_borders(model);
    auto cut = arrangement::arrange(model.model.soup, {.tolerance = model.lengths.tolerance, .reach = reach, .monitor = options.monitor});
    if (!cut) return std::move(cut).why();
    StepOutcome outcome;
    outcome.what.message = message_of(*cut, nothing);
    if (!cut->clean) outcome.what.message += "; after " + counted(cut->rounds, "round", "rounds") + " something still crosses";
    outcome.changed = cut->cut + cut->merged + cut->collapsed + cut->doubled;
    const Displacement d = displacement(model.model.soup, cut->soup, cut->becomes);
    outcome.max_displacement = d.largest;
    outcome.mean_displacement = d.mean;
    take_soup(model, std::move(cut->soup), cut->origin);
    tell_overlaps(model, leave_out_overlaps(model), outcome);
    return outcome;
}

}  // namespace

Result<StepOutcome> weld_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    constexpr double nearly_all = 0.99;  // vertices keep the tolerance from each other, so that edges bend and do not fold
    return arrange_model(model, options, nearly_all, "nothing lies within the tolerance of something else, and nothing crosses");
}

Result<StepOutcome> cut_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    return arrange_model(model, options, arrangement::ArrangeOptions().reach, "nothing crosses");
}

}  // namespace geomend::repair
