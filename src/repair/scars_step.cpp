// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/wording.h"
#include "repair/scars.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

void add_part(std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; }

std::string done_text(const ScarCounts& c) {
    std::string text;
    if (c.lips > 0) add_part(text, counted(c.lips, "edge", "edges") + " stitched");
    if (c.joined > 0) add_part(text, counted(c.joined, "part of a surface", "parts of surfaces") + " joined to others");
    if (c.restored > 0) add_part(text, counted(c.restored, "triangle", "triangles") + " again as read");
    if (c.erased > 0) add_part(text, counted(c.erased, "vertex", "vertices") + " erased");
    return text;
}

std::string left_text(const ScarCounts& c, double distance) {
    std::string text;
    if (c.bent > 0) add_part(text, counted(c.bent, "edge", "edges") + " where the surface bends");
    if (c.needed > 0) add_part(text, counted(c.needed, "vertex", "vertices") + " where lines end, part or bend");
    if (c.border > 0) add_part(text, counted(c.border, "vertex", "vertices") + " on free borders");
    if (c.not_flat > 0)
        add_part(text, counted(c.not_flat, "vertex", "vertices") + " without which a surface would move by more than " + rounded(distance));
    return text;
}

}  // namespace

std::string scars_text(const ScarCounts& counts, double distance) {
    const std::string done = done_text(counts), left = left_text(counts, distance);
    return (done.empty() ? "no scar is left that nothing needs" : done) + (left.empty() ? "" : "; left: " + left);
}

ScarRules scar_rules(const SurfaceModel& model, const SurfaceStepOptions& options) {
    return {options.scar_angle, model.lengths.tolerance, model.lengths.tolerance};
}

Result<StepOutcome> remove_scars(SurfaceModel& model, const SurfaceStepOptions& options) {
    const ScarRules rules = scar_rules(model, options);
    ScarCounts counts;
    auto trace = stitch_lips(model, rules, counts);
    restore_by_origin(model, trace, counts);
    erase_scars(model, trace, true, rules, counts);
    StepOutcome outcome;
    outcome.changed = counts.changes();
    outcome.what.message = scars_text(counts, rules.distance);
    return outcome;
}

}  // namespace geomend::repair
