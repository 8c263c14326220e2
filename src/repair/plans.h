// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/finding.h"
#include "repair/surface_driver.h"

namespace geomend::repair {

/// Steps, and the tolerance that they are taken by.
struct SurfacePlan {
    std::vector<std::string> steps;
    double tolerance = -1;  ///< negative: as the user has it, or by rule
    std::string why;        ///< why it is tried at all; empty: it is the usual one
};

/// What decides about plans.
struct PlanFacts {
    std::span<const Finding> findings;  ///< at the tolerance that the user asked for, or by rule
    std::span<const Finding> strict;    ///< at the one by rule, where that is smaller; else the same
    /// A tolerance at which borders become one and all errors (whole) or most of them vanish, where the user named none.
    std::optional<double> closing;
    bool closes_whole = false;
    bool close_gaps = false;  ///< borders that stop short are closed also where no check finds them near
    bool box = false;         ///< a box is added
    /// Models that may be sound each by itself become one: where they meet they are cut along what they share.
    bool several_models = false;
};

/// The plans that are worth a try, the most promising first; none where nothing was found that a step mends.
std::vector<SurfacePlan> plans_for(const PlanFacts& facts);

/// What came of the best plan.
struct PlannedRepair {
    SurfaceRepair repair;
    SurfacePlan plan;
    /// A tolerance at which the model would close without errors, too large to be taken without being asked for.
    std::optional<double> would_close;
    /// A gap with which it would, where borders stop short by more than is closed unasked.
    std::optional<double> would_close_gap;
    /// Sheets that face each other in a sound result, and would be one by a tolerance that is not taken without being asked for.
    struct WouldJoin {
        double tolerance = 0;
        std::uint64_t regions = 0;  ///< no thicker than that, which would be gone
    };
    std::optional<WouldJoin> would_join{};
};

/// Takes the steps of one plan after the other until a model has no errors and is closed where it should be. Of several that end
/// worse the best is taken: with fewest errors, by rule and by a larger tolerance that was asked for, then fewest borders that nearly meet
/// a surface, the earlier one of equals. As repair_surfaces() for each. \pre there is a plan \param search where none of them mends it, the
/// lengths at which border points come together are looked for, and tried
Result<PlannedRepair> repair_by_plans(const Dataset& dataset, std::span<const Finding> before, std::span<const SurfacePlan> plans,
                                      const SurfaceDriverOptions& options, bool search);

}  // namespace geomend::repair
