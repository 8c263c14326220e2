// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/brep.h"

namespace geomend::repair {

/// Regions no thicker than so many tolerances, on average, need not survive a repair.
constexpr double not_to_be_lost = 4;

/// Whether the regions of a model are still there in another one made from it: each needs a closed region of its own around the
/// points that were inside of it. Regions no thicker than `thin` (twice the volume by the area) need not survive, nor do those that
/// `may_go` lets go: it is asked with a point inside of them.
/// \return which one is lost and where it went, in words; empty: all are there. Cost: n log n, logarithmic for each region.
std::string lost_region(const BrepData& before, const BrepData& after, double thin, const std::function<bool(const Vec3&)>& may_go);

/// How many regions are no thicker than `thin`. Cost: linear in the triangles around regions.
std::uint64_t thin_regions(const BrepData& brep, double thin);

}  // namespace geomend::repair
