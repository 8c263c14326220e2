// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "support/program.h"

namespace geomend::test {

/// The volumes of the regions of a model, ascending, as `info` has them.
inline std::vector<double> region_volumes(const std::string& path) {
    std::vector<double> volumes;
    const auto told = info(path)["brep"]["region_volumes"];
    for (const auto& region : told) volumes.push_back(region["volume"].get<double>());
    std::ranges::sort(volumes);
    return volumes;
}

}  // namespace geomend::test
