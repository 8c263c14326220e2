// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "validators/model_scope.h"

// Models whose patches were rounded each by itself on export: their borders agree within some length that is larger than the
// tolerance, and everything is wrong by rule although nothing is amiss. The length is found, not guessed: a tolerance is only
// named after the model has been judged at it.

namespace geomend::validators {

/// A tolerance at which most of what is wrong vanishes.
struct ClosingTolerance {
    double tolerance = 0;
    std::uint64_t errors = 0;  ///< without it
    std::uint64_t left = 0;    ///< of these with it; 0: the model closes
};

/// The vertices on the lines of one model, and the lengths between which its borders may agree.
struct BorderPoints {
    std::vector<Vec3> positions;
    double tolerance = 0, near = 0;
};

/// Cost: as the number of edges on lines.
BorderPoints border_points(const ModelScope& scope);

/// Tolerances of one digit, ascending, at most three: where so many points of borders become one that the next ones that do are
/// twice as far apart or farther. None where no two come within `near`. Cost: as the number of points, times the digits between
/// tolerance and near.
std::vector<double> tolerances_to_try(std::span<const BorderPoints> models);

/// The same for lengths that are measured already: where the next larger ones are twice as long or longer.
std::vector<double> tolerances_to_try(std::span<const double> lengths, double tolerance, double near);

/// The smallest of these tolerances at which no error is left, or else, where there are ten errors or more, the one that leaves
/// fewest, if that is a tenth of them at most. Each is tried by judging everything again.
/// \param errors_at the errors that are left at a tolerance; its failures end the search
Result<std::optional<ClosingTolerance>> closing_tolerance(std::span<const double> tolerances, std::uint64_t errors,
                                                          const std::function<Result<std::uint64_t>(double)>& errors_at);

}  // namespace geomend::validators
