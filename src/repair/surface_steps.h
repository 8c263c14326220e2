// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/finding.h"
#include "base/monitor.h"
#include "repair/surface_edits.h"
#include "repair/surface_model.h"

namespace geomend::repair {

class KnownCuts;

/// What the user decides about the borders of a surface, or about those of them that lie near another one.
struct ContactWish {
    std::string border, on;  ///< names of surfaces; `on` empty: any
    bool close = true;       ///< false: left as they are
    Location where{};        ///< in the recipe
};

/// What the user says of the steps.
struct SurfaceStepOptions {
    double max_gap = -1;                      ///< largest gap that is closed and largest overshoot that is trimmed; negative: 1e-3 D
    std::optional<std::array<Vec3, 2>> box;   ///< low and high corner of the box that is added
    bool automatic_box = false;               ///< a box is added that fits the surfaces
    std::span<const ContactWish> contacts{};  ///< what the user decided about borders
    double scar_angle = 45;                   ///< degrees: two lips of a scar that bend by more are not stitched
    double micro_volume = -1;                 ///< smaller regions are merged into others; negative: a millionth of the whole
    std::span<const SurfaceEdit> edits{};     ///< what the user wants changed
    const Monitor* monitor = nullptr;
    KnownCuts* cuts = nullptr;  ///< of plans that were tried; nullptr: none are kept
};

/// The largest gap that is closed, hole that is filled and overshoot that is trimmed: as given, but a tenth of D at most; else a
/// thousandth of D. D is that of what was read: neither a box nor a point that lies far off makes it larger.
inline double gap_limit(const SurfaceModel& model, const SurfaceStepOptions& options) {
    return options.max_gap >= 0 ? std::min(options.max_gap, 0.1 * model.diameter) : 1e-3 * model.diameter;
}
/// The same for each patch, by the D of the cluster that it was read in where none is given.
std::vector<double> gap_limits(const SurfaceModel& model, const SurfaceStepOptions& options);

/// What was decided about a piece of a border that nearly meets another surface.
struct ContactDecision {
    std::string border, on;  ///< surfaces
    double gap = 0;          ///< the largest along the surface
    std::string decision;    ///< closed, trimmed or left
    std::string why;
};

/// What a step did. `what` has its message, entities and places, and no code.
struct StepOutcome {
    Finding what;
    std::uint64_t changed = 0;                           ///< triangles, vertices or pieces, as the message says; 0: the model is as it was
    double max_displacement = 0, mean_displacement = 0;  ///< of the vertices that moved
    std::vector<ContactDecision> contacts;               ///< of a step that decides about borders
};

/// A step that changes the surfaces of a model.
using SurfaceStep = Result<StepOutcome> (*)(SurfaceModel&, const SurfaceStepOptions&);

struct SurfaceStepRow {
    std::string_view name;
    std::string_view meaning;                 ///< one line
    std::span<const std::string_view> mends;  ///< codes of findings for which it is taken where no step is named
    SurfaceStep run;
    bool leads_to_cut = false;     ///< the model is not judged after it, but once what follows is done: cut, tails
    bool changes_regions = false;  ///< regions may go and come by it, as it was asked for
    bool only_named = false;       ///< taken only where it is named, whatever was found
};

/// All steps, in the order in which they are taken where none is named.
std::span<const SurfaceStepRow> surface_steps();
/// The row of a step, or nullptr.
const SurfaceStepRow* surface_step(std::string_view name);

/// How far vertices moved between two soups.
struct Displacement {
    std::uint64_t moved = 0;
    double largest = 0, mean = 0;
};
/// Of the vertices of `before`, those that became one with others, too. \param becomes per vertex the one that it is in `after`, or
/// no_index. Linear.
Displacement displacement(const TriangleSoup& before, const TriangleSoup& after, std::span<const std::uint32_t> becomes);

// The steps.
Result<StepOutcome> edit_surfaces(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> clean_surfaces(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> add_box(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> fill_holes(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> weld_surfaces(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> cut_surfaces(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> close_borders(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> remove_tails(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> remove_scars(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> merge_micro_regions(SurfaceModel&, const SurfaceStepOptions&);
Result<StepOutcome> rebuild_surfaces(SurfaceModel&, const SurfaceStepOptions&);

}  // namespace geomend::repair
