// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/arrange.h"
#include "base/wording.h"
#include "repair/soup_edges.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

std::string message_of(const arrangement::Arrangement& a) {
    if (a.cut + a.merged + a.collapsed + a.doubled + a.made == 0) return "nothing crosses";
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

/// \param reach share of the tolerance within which a vertex becomes a part of an edge or a face
Result<StepOutcome> arrange_model(SurfaceModel& model, const SurfaceStepOptions& options, double reach) {
    note_uncut_borders(model);
    auto cut = arrangement::arrange(model.model.soup, {.tolerance = model.lengths.tolerance, .reach = reach, .monitor = options.monitor});
    if (!cut) return std::move(cut).why();
    StepOutcome outcome;
    outcome.what.message = message_of(*cut);
    if (!cut->clean) outcome.what.message += "; after " + counted(cut->rounds, "round", "rounds") + " something still crosses";
    outcome.changed = cut->cut + cut->merged + cut->collapsed + cut->doubled;
    const Displacement d = displacement(model.model.soup, cut->soup, cut->origin);
    outcome.max_displacement = d.largest;
    outcome.mean_displacement = d.mean;
    take_soup(model, std::move(cut->soup), cut->origin);
    return outcome;
}

}  // namespace

Result<StepOutcome> weld_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    constexpr double nearly_all = 0.9;  // vertices keep the tolerance from each other, so that edges bend and do not fold
    return arrange_model(model, options, nearly_all);
}

Result<StepOutcome> cut_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    return arrange_model(model, options, arrangement::ArrangeOptions().reach);
}

}  // namespace geomend::repair
