// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace geomend {

/// The number of the cell that a length of so many cells lies in: rounded down. What lies beyond all such numbers, or is no number, lies
/// in a cell at their end, from which some thousands of others can still be counted.
inline std::int64_t cell_number(double cells) {
    constexpr double most = 4e18;
    return cells > -most ? static_cast<std::int64_t>(std::floor(std::min(cells, most))) : static_cast<std::int64_t>(-most);
}

}  // namespace geomend
