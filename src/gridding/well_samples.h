// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "gridding/property_means.h"
#include "model/objects.h"

namespace geomend::gridding {

/// The active cells of a grid that values along a well lie in, ascending, with one value each: of values weighted by half the way to
/// the ones before and after, or for Averaging::nearest the one nearest to the cell's middle. Harmonic is along the path. Values beyond
/// the path's ends are left out. A well without measured depths has them from its first point on.
/// Cost: linear in cells, logarithmic a value.
std::vector<std::pair<std::uint32_t, double>> well_samples(const CornerPointGrid& grid, const Well& well, std::span<const double> depths,
                                                           std::span<const double> values, Averaging how);

}  // namespace geomend::gridding
