// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/convert.h"
#include "pipeline/validate.h"

namespace geomend {

struct RepairRequest {
    ConvertRequest files;                        ///< one input
    std::vector<std::string> steps;              ///< in the order in which they are taken; empty: those that mend what is found
    std::optional<double> gap;                   ///< for close-gaps of grids
    double max_gap = -1, max_displacement = -1;  ///< of surfaces; negative: by rule, no limit
    bool keep_invalid = false;                   ///< write a result that still has errors
    validators::CheckOptions checks;
    Inspect inspect;  ///< sees the result with its findings and steps, whether it is written or not
};

/// What came of a repair.
struct RepairReport {
    ReportedFile file;         ///< what is found after it, and what each step did
    bool valid_before = true;  ///< no error was found before
    bool written = false;
    std::vector<Loss> losses;
};

/// Reads all inputs as one model, takes the steps, validates the result and writes it: also where it still has errors, if that
/// is accepted, else not (`written` tells). Failure (usage) where there is neither a corner-point grid nor a surface.
/// Other failures are those of convert().
Result<RepairReport> repair_file(const RepairRequest& request);

}  // namespace geomend
