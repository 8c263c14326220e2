// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

// The loops over the values of a grid, which take several at once where the processor can: that is half of what they cost.

namespace geomend::eclipse {

/// Turns big-endian reals of single precision into doubles.
/// \return whether all of them are finite
/// \pre bytes has 4 * count bytes, to has room for count values
bool widen(const char* bytes, std::size_t count, double* to);

/// Keeps the lowest byte of big-endian integers.
/// \return all bits that any of them has: above 255 where one does not fit
/// \pre as widen()
std::uint32_t narrow(const char* bytes, std::size_t count, std::uint8_t* to);

}  // namespace geomend::eclipse
