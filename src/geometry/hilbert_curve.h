// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace geomend {

/// Place of a cell on the Hilbert curve through a cube of 2^bits cells a side (J. Skilling, "Programming the Hilbert
/// curve", AIP Conference Proceedings 707, 2004). \pre 1 <= bits <= 21, all of x less than 2^bits. Cost: a table look-up a bit
std::uint64_t hilbert_place(const std::array<std::uint32_t, 3>& x, unsigned bits);

}  // namespace geomend
