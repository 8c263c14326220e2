// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/convert.h"
#include "pipeline/validate.h"
#include "repair/model_changes.h"
#include "repair/recipe.h"

namespace geomend {

/// Looks at what came of a repair, with what it did to the model, as Inspect does.
using InspectRepair = std::function<Result<void>(const Dataset&, std::span<const Brep>, const repair::ModelChanges&, ReportedFile&)>;

struct RepairRequest {
    ConvertRequest files;       ///< one input
    repair::Recipe recipe;      ///< steps in the order in which they are taken; none: those that mend what is found
    std::optional<double> gap;  ///< for close-gaps of grids
    bool dry_run = false;       ///< all is done, but nothing is written
    bool keep_invalid = false;  ///< write a result that still has errors
    validators::CheckOptions checks;
    Inspect look;           ///< sees what was read, with what is found in it, before anything is done; called where `inspect` is
    InspectRepair inspect;  ///< sees the result with its findings and steps, whether it is written or not
};

/// What came of a repair.
struct RepairReport {
    ReportedFile file;         ///< what is found after it, and what each step did
    bool valid_before = true;  ///< no error was found before
    bool written = false;
    bool closed = false;    ///< the result has a region, or is a grid; without one it is not called valid where the input was not
    bool open = false;      ///< the model should close around volumes, but has no region
    bool edited = true;     ///< false: an edit that was asked for was undone, so that nothing is written
    repair::Recipe recipe;  ///< with which the same is done again: the steps that were taken, and the lengths
    std::vector<Loss> losses;
};

/// Reads all inputs as one model, takes the steps, validates the result and writes it: also where it still has errors, if that
/// is accepted, else not (`written` tells). Failure (usage) where there is neither a corner-point grid nor a surface.
/// Other failures are those of convert().
Result<RepairReport> repair_file(const RepairRequest& request);

}  // namespace geomend
