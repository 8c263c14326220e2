// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/arrange.h"
#include "base/number_text.h"
#include "base/wording.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

std::string message_of(const arrangement::Arrangement& a) {
    if (a.cut + a.merged + a.collapsed + a.doubled + a.made == 0) return "nothing crosses";
    return counted(a.cut, "triangle was cut", "triangles were cut") + ", " + counted(a.made, "vertex", "vertices") + " made, " +
           counted(a.merged, "vertex", "vertices") + " merged, " + counted(a.collapsed, "triangle", "triangles") +
           " without area left out, " + counted(a.doubled, "double", "doubles") + " left out";
}

}  // namespace

Result<StepOutcome> cut_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    auto cut = arrangement::arrange(model.model.soup, {.tolerance = model.lengths.tolerance, .monitor = options.monitor});
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

}  // namespace geomend::repair
