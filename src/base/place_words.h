// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <string>

namespace geomend {

/// A coordinate inside a message for people, so that the place can be found: as many decimals as give eight digits, and at least
/// thousandths, without zeros at the end; powers of ten from 1e15 up only. Reports and --json have all digits.
std::string coordinate(double value);

/// "(453001, 6780120.4, -1999.62)": all three have the decimals of the largest, so that an error of rounding beside it reads as zero.
std::string place_words(const std::array<double, 3>& place);

}  // namespace geomend
