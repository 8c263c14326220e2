// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "hexes/conflicts.h"

namespace geomend::hexes {

struct LocalSearch {
    std::uint64_t steps = 0;  ///< how many candidates are tried; 200 for each is much, 20 little
    double heat = 0.3;        ///< losses that are accepted in the beginning, by the weight of the candidate; they sink to a hundredth
    std::uint32_t seed = 1;
    std::span<const std::uint32_t> among = {};  ///< candidates that are tried; empty: all
    const Monitor* monitor = nullptr;
};

/// Looks for a selection of greater weight. A step tries one candidate, chosen at random: it is taken and all in conflict with it are
/// left out where that is a gain, or, at first more often than later, where it is a small loss (simulated annealing). In the end each
/// candidate heavier than those in its way is taken until there is none. The best selection that was come by is returned, never one
/// lighter than the start; where nothing is in the way of anything it ends at once. The generator is the function's own: the result depends
/// on nothing but its arguments, and not on time. Weights are counted in units of 2^-40 of their sum. Candidates of no weight are not
/// taken. Cost: 10 ns a step that is not taken, some microseconds one that is.
std::vector<std::uint32_t> search_selection(const Conflicts& conflicts, std::span<const double> weights,
                                            std::span<const std::uint32_t> start, const LocalSearch& how);

}  // namespace geomend::hexes
