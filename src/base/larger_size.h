// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>

#include "base/wording.h"

namespace geomend {

/// What a message offers in place of a size that makes too much: a number of two digits, at least a twentieth above the one given.
inline std::string two_digits_above(double least) {
    if (!(least > 0) || !std::isfinite(least)) return rounded(least);
    const double wanted = 1.05 * least, unit = std::pow(10.0, std::floor(std::log10(wanted)) - 1);
    return rounded(std::ceil(wanted / unit) * unit);
}

}  // namespace geomend
