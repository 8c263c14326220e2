// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "repair/surface_result.h"
#include "repair/surface_steps.h"
#include "validators/registry.h"

namespace geomend::repair {

struct SurfaceStepDone;

/// What was undone of plans that were tried, by the steps that were kept before it and the lengths: it is not done again.
using UndoneSteps = std::map<std::string, std::vector<SurfaceStepDone>>;

struct SurfaceDriverOptions {
    SurfaceStepOptions steps;
    double max_displacement = -1;     ///< a step that moves a vertex farther is undone; negative: no limit
    bool keep_model = false;          ///< what was mended is given back, too, so that changes_of() can compare it
    bool keep_worse = false;          ///< steps are kept also where the model is worse after them
    validators::CheckOptions checks;  ///< by which the model is judged between steps
    UndoneSteps* undone = nullptr;    ///< of the same Dataset, and but for lengths the same options; nullptr: none are kept
};

/// What the driver did with a step.
struct SurfaceStepDone {
    std::string step;
    bool kept = true;
    StepOutcome outcome;
    double seconds = 0;      ///< of processor time, judging left out
    double peak_memory = 0;  ///< bytes of the whole process while it ran; 0: not known
    std::string why;         ///< why it was undone
};

/// The errors of a model: how many findings of each code.
using ErrorCounts = std::map<std::string, std::uint64_t>;
ErrorCounts errors_of(std::span<const Finding> findings);
/// Why a model with the errors `after` is worse than one with `before`: it has a code that the other has not, or more findings
/// in all. Empty: it is not.
std::string why_worse(const ErrorCounts& before, const ErrorCounts& after);

/// The steps that mend what was found, in their order; empty: nothing was found that a step mends.
/// \param close_gaps borders that stop short are closed also where no check finds them near
/// \param box a box is added
std::vector<std::string> plan_for(std::span<const Finding> findings, bool close_gaps, bool box = false);

struct SurfaceRepair {
    SurfaceResult result;
    std::vector<SurfaceStepDone> steps;
    topology::Lengths lengths;           ///< by which the model was mended and judged
    std::vector<std::uint32_t> objects;  ///< of the Dataset that the result takes the place of, ascending
    ErrorCounts errors;                  ///< that are left, by the tolerance that the model was judged at; see also repair_by_plans()
    std::uint64_t near_misses = 0;       ///< borders that still nearly meet a surface
    bool should_close = false;           ///< it had regions, or surfaces that are stated to bound it, or an error said that it is open
    bool closed = false;                 ///< it has a region
    std::optional<SurfaceModel> model;   ///< what was mended, where it is to be kept
};

/// Takes the steps on all surfaces of a Dataset, as one model, and judges it after each: a step after which the model is worse
/// is undone whole: one with more errors, that has lost a region or a surface, or in which a vertex moved too far. It is judged by
/// the tolerance by rule where a larger one is given, since what was not welded is not one for others. Steps that lead to a cut, the cut
/// and the removal of tails are judged together, since what was lengthened crosses until it is cut; where they are undone, cut and tails
/// are tried without them. \param before what was found in the Dataset, by that tolerance  \pre names are of surface_steps() Failure
/// (cancelled) when stopped.
Result<SurfaceRepair> repair_surfaces(const Dataset& dataset, std::span<const Finding> before, std::span<const std::string> names,
                                      const SurfaceDriverOptions& options);

}  // namespace geomend::repair
