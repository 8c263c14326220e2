// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gridding/chains.h"
#include "gridding/structure.h"

namespace geomend::gridding {

/// What came of leaning the pillars of a fault.
struct LeanReport {
    bool leans = false;
    double max_shift = 0;  ///< of a pillar between the upper and the lower level
    std::string why_not;   ///< empty where it leans, or the fault is not in the grid
};

struct LeanResult {
    std::vector<LeanReport> faults;              ///< per fault
    double angles_before = 0, angles_after = 0;  ///< mean right-angledness of columns at both levels, 0 to 1
    double least_before = 0, least_after = 0;    ///< the least one
    bool border_relaxed = false;                 ///< nodes of the border were relaxed towards upright columns, not only spread evenly
    std::uint64_t negative_weights = 0;          ///< of the harmonic map
};

/// Gives the pillars of chains the lean of their faults: at each of two levels a pillar is shifted, along I or J, as the fault's surface is
/// there against its trace. All other pillars follow by the harmonic map between these and the border, whose nodes slide along it.
/// After each fault the columns are measured at both levels and at `levels`: where one has turned over, or is less than a tenth of its
/// size before, the pillars of that fault stay upright. Faults without a surface stay upright. In the end the border is relaxed
/// towards upright columns (relax_border), where columns hold with that and are no less right-angled, neither on average nor the least.
/// \param net upright; leans afterwards. \param upper, lower the two levels of pillars
LeanResult lean_pillars(const Structure& structure, const Chains& chains, double upper, double lower, const std::vector<double>& levels,
                        Net& net);

}  // namespace geomend::gridding
