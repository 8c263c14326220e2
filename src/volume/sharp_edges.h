// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volume/region_facets.h"

namespace geomend::volumes {

/// Two facets that meet along an edge at a small angle, with the region between them.
struct SharpEdge {
    std::array<std::uint32_t, 2> ends;  ///< over the vertices of the facets, the lower one first
    std::array<std::uint32_t, 2> facets;
    double angle;  ///< radians
};

/// Those below an angle in radians, ascending by ends. Cost: n log n.
std::vector<SharpEdge> sharp_edges(const RegionFacets& facets, double below);

}  // namespace geomend::volumes
