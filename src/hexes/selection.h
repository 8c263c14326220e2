// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hexes/conflicts.h"

namespace geomend::hexes {

/// By what the next candidate is chosen, the largest first; of equal ones the first.
enum class Greedy : std::uint8_t {
    weight,            ///< its weight
    weight_by_degree,  ///< weight / (number of its conflicts + 1)
    weight_by_sum,     ///< weight / (its weight and those of its conflicts)
    weight_less_sum,   ///< weight - those of its conflicts
    least_degree,      ///< - number of its conflicts
};

/// Takes one candidate after the other, each time the best by a rule, and strikes out those in conflict with it, until none is left.
/// Conflicts with candidates that were struck out no longer count. Source: A. Botella (2016), algorithm 3.1.
/// Candidates of no weight are not taken.
/// \return the selected, ascending. Cost: n log n in conflicts; for Greedy::weight linear in what is selected
std::vector<std::uint32_t> select_greedily(const Conflicts& conflicts, std::span<const double> weights, Greedy rule);

}  // namespace geomend::hexes
