// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/triangle_soup.h"

namespace geomend::test {

/// A random soup and the tolerance to cut it with.
struct RandomSoup {
    TriangleSoup soup;
    double tolerance = 0;
};

/// The names of the kinds of random soups that there are: see soup_kinds.cpp.
const std::vector<std::string>& soup_kinds();

/// The soup of a kind and a seed: the same each time. The tolerance is 1e-7 to 1e-3 of its size, by the seed. \pre the kind exists
RandomSoup random_soup(const std::string& kind, unsigned seed);

}  // namespace geomend::test
